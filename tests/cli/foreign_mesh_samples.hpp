// A box of 1 × 2 × 3 in files that are neither STL nor OFF.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace graycube::testing {

inline constexpr std::array<std::array<int, 3>, 8> kBoxPoints{
    {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 2, 0}, {0, 0, 3}, {1, 0, 3}, {0, 2, 3}, {1, 2, 3}}};
inline constexpr std::array<std::array<int, 3>, 12> kBoxTriangles{{{0, 2, 3},
                                                                   {0, 3, 1},
                                                                   {4, 5, 7},
                                                                   {4, 7, 6},
                                                                   {0, 1, 5},
                                                                   {0, 5, 4},
                                                                   {2, 6, 7},
                                                                   {2, 7, 3},
                                                                   {0, 4, 6},
                                                                   {0, 6, 2},
                                                                   {1, 3, 7},
                                                                   {1, 7, 5}}};

/// A text for each item of a list, one after the other.
template <typename List, typename Write>
std::string joined(const List& list, Write&& write) {
  std::string text;
  for (const auto& [a, b, c] : list)
    text += write(std::to_string(a), std::to_string(b), std::to_string(c));
  return text;
}
inline std::string spaced(const std::string& a, const std::string& b, const std::string& c) {
  return a + " " + b + " " + c + " ";
}

inline std::string ply_text() {
  return "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty "
         "float z\nelement face 12\nproperty list uchar int vertex_indices\nend_header\n" +
         joined(kBoxPoints, [](auto a, auto b, auto c) { return spaced(a, b, c) + "\n"; }) +
         joined(kBoxTriangles,
                [](auto a, auto b, auto c) { return "3 " + spaced(a, b, c) + "\n"; });
}

/// The triangles from `first` up to `end` of the box as OBJ; indices count from 1.
inline std::string obj_faces(std::size_t first, std::size_t end) {
  std::string text;
  for (std::size_t t = first; t < end; ++t) {
    text += "f";
    for (const int i : kBoxTriangles[t]) text += " " + std::to_string(i + 1);
    text += "\n";
  }
  return text;
}
inline std::string obj_points() {
  return joined(kBoxPoints, [](auto a, auto b, auto c) { return "v " + spaced(a, b, c) + "\n"; });
}

inline std::string base64(const std::string& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t v = 0;
    for (std::size_t k = 0; k < 3; ++k)
      v = v << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[v >> (18 - 6 * k) & 63];
  }
  return text;
}

inline void put_little(std::string& bytes, std::uint32_t v, int size) {
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(v >> (8 * i) & 0xFF);
}

/// The box twice as large in every direction, moved by 10 along x.
inline std::string gltf_text() {
  std::string buffer;
  for (const auto& p : kBoxPoints) {
    for (const int v : p)
      put_little(buffer, std::bit_cast<std::uint32_t>(static_cast<float>(v)), 4);
  }
  for (const auto& t : kBoxTriangles) {
    for (const int i : t) put_little(buffer, static_cast<std::uint32_t>(i), 2);
  }
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"outer",
"translation":[10,0,0],"children":[1]},{"name":"inner","scale":[2,2,2],"mesh":0}],"meshes":[{
"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[{"bufferView":0,
"componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],"max":[1,2,3]},{"bufferView":1,
"componentType":5123,"count":36,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":96},
{"buffer":0,"byteOffset":96,"byteLength":72}],"buffers":[{"byteLength":168,"uri":
"data:application/octet-stream;base64,)" +
         base64(buffer) + "\"}]}";
}

/// Collada of the box, with this axis up.
inline std::string dae_text(const std::string& up) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"
version="1.4.1"><asset><up_axis>)" +
         up +
         R"(</up_axis></asset><library_geometries><geometry id="g" name="g"><mesh><source id="p">
<float_array id="pa" count="24">)" +
         joined(kBoxPoints, spaced) +
         R"(</float_array><technique_common><accessor source="#pa" count="8" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/>
</vertices><triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>)" +
         joined(kBoxTriangles, spaced) +
         R"(</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>
<visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

inline std::string amf_text() {
  const auto point = [](auto a, auto b, auto c) {
    return "<vertex><coordinates><x>" + a + "</x><y>" + b + "</y><z>" + c +
           "</z></coordinates></vertex>";
  };
  const auto triangle = [](auto a, auto b, auto c) {
    return "<triangle><v1>" + a + "</v1><v2>" + b + "</v2><v3>" + c + "</v3></triangle>";
  };
  return R"(<?xml version="1.0"?><amf unit="millimeter"><object id="0"><mesh><vertices>)" +
         joined(kBoxPoints, point) + "</vertices><volume>" + joined(kBoxTriangles, triangle) +
         "</volume></mesh></object></amf>";
}

inline constexpr const char* kFbxQuads = "0,2,3,-2,4,5,7,-7,0,1,5,-5,2,6,7,-4,0,4,6,-3,1,3,7,-6";
inline constexpr std::array<int, 6> kFbxZUp{2, 1, 1, -1, 0, 1}, kFbxYUp{1, 1, 2, 1, 0, 1};

/// An FBX of the box as six quads, the last corner of each as FBX marks it: −1 − index. `axes` are
/// up, its sign, front, its sign, right, its sign; `placed` are properties of its node.
inline std::string fbx_text(const std::array<int, 6>& axes, const std::string& placed = {},
                            const std::string& quads = kFbxQuads) {
  constexpr const char* kAxes[] = {"UpAxis",        "UpAxisSign", "FrontAxis",
                                   "FrontAxisSign", "CoordAxis",  "CoordAxisSign"};
  std::string settings, points;
  for (std::size_t i = 0; i < axes.size(); ++i)
    settings += std::string("P: \"") + kAxes[i] + "\", \"int\", \"Integer\", \"\"," +
                std::to_string(axes[i]) + "\n";
  points = joined(kBoxPoints, [](auto a, auto b, auto c) { return a + "," + b + "," + c + ","; });
  points.pop_back();
  return "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXHeaderVersion: 1003\n"
         "FBXVersion: 7400\n}\nGlobalSettings: {\nVersion: 1000\nProperties70: {\n" +
         settings +
         "P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",100\n}\n}\nDefinitions: {\n"
         "Version: 100\nCount: 2\nObjectType: \"Geometry\" {\nCount: 1\n}\n"
         "ObjectType: \"Model\" {\nCount: 1\n}\n}\nObjects: {\n"
         "Geometry: 1, \"Geometry::box\", \"Mesh\" {\nVertices: *24 {\na: " +
         points + "\n}\nPolygonVertexIndex: *24 {\na: " + quads +
         "\n}\nGeometryVersion: 124\n}\nModel: 2, \"Model::box\", \"Mesh\" {\nVersion: 232\n"
         "Properties70: {\n" +
         placed +
         "\n}\nShading: T\nCulling: \"CullingOff\"\n}\n}\nConnections: {\nC: \"OO\",2,0\n"
         "C: \"OO\",1,2\n}\n";
}

inline std::string x3d_text() {
  const auto triangle = [](auto a, auto b, auto c) { return spaced(a, b, c) + "-1 "; };
  return R"(<?xml version="1.0"?><X3D version="3.0"><Scene><Shape><IndexedFaceSet coordIndex=")" +
         joined(kBoxTriangles, triangle) + R"("><Coordinate point=")" + joined(kBoxPoints, spaced) +
         R"("/></IndexedFaceSet></Shape></Scene></X3D>)";
}

/// The remainder that ZIP files keep of their members (ISO 3309).
inline std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

/// An archive of files that are stored as they are (PKWARE's APPNOTE, 4.3.7 to 4.3.16).
inline std::string zip_bytes(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string archive, index;
  for (const auto& [name, text] : files) {
    const auto at = static_cast<std::uint32_t>(archive.size());
    const auto size = static_cast<std::uint32_t>(text.size());
    std::string head;
    for (const std::uint32_t v : {20u, 0u, 0u, 0u, 0x21u}) put_little(head, v, 2);
    for (const std::uint32_t v : {crc32(text), size, size}) put_little(head, v, 4);
    put_little(head, static_cast<std::uint32_t>(name.size()), 2);
    put_little(head, 0, 2);
    archive += std::string("PK\x03\x04") + head + name + text;
    index += std::string("PK\x01\x02\x14") + '\0' + head;
    put_little(index, 0, 2);
    put_little(index, 0, 4);
    put_little(index, 0, 4);
    put_little(index, at, 4);
    index += name;
  }
  const auto at = static_cast<std::uint32_t>(archive.size());
  archive += index + "PK\x05\x06";
  put_little(archive, 0, 4);
  for (int i = 0; i < 2; ++i) put_little(archive, static_cast<std::uint32_t>(files.size()), 2);
  put_little(archive, static_cast<std::uint32_t>(index.size()), 4);
  put_little(archive, at, 4);
  put_little(archive, 0, 2);
  return archive;
}

/// The box moved by 10 along x, and mirrored at z = 0.
inline std::string threemf_bytes() {
  const auto point = [](auto a, auto b, auto c) {
    return "<vertex x=\"" + a + "\" y=\"" + b + "\" z=\"" + c + "\"/>";
  };
  const auto triangle = [](auto a, auto b, auto c) {
    return "<triangle v1=\"" + a + "\" v2=\"" + b + "\" v3=\"" + c + "\"/>";
  };
  const std::string model =
      R"(<?xml version="1.0" encoding="UTF-8"?><model unit="millimeter" xml:lang="en-US"
xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1"
type="model" name="a part"><mesh><vertices>)" +
      joined(kBoxPoints, point) + "</vertices><triangles>" + joined(kBoxTriangles, triangle) +
      R"(</triangles></mesh></object></resources><build><item objectid="1"
transform="1 0 0 0 1 0 0 0 -1 10 0 0"/></build></model>)";
  return zip_bytes(
      {{"[Content_Types].xml",
        R"(<?xml version="1.0"?>)"
        R"(<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">)"
        R"(<Default Extension="rels" )"
        R"(ContentType="application/vnd.openxmlformats-package.relationships+xml"/>)"
        R"(<Default Extension="model" )"
        R"(ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>)"},
       {"_rels/.rels",
        R"(<?xml version="1.0"?>)"
        R"(<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">)"
        R"(<Relationship Target="/3D/3dmodel.model" Id="rel0" )"
        R"(Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>)"
        R"(</Relationships>)"},
       {"3D/3dmodel.model", model}});
}

}  // namespace graycube::testing
