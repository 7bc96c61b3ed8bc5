# The library of scene families, for the benchmarks and for the guard among the tests, whichever of
# the two folders is configured.
include_guard(GLOBAL)
add_library(graycube_scene_families STATIC
  ${CMAKE_CURRENT_LIST_DIR}/field_scene.cpp ${CMAKE_CURRENT_LIST_DIR}/flake_scene.cpp
  ${CMAKE_CURRENT_LIST_DIR}/glass_scene.cpp ${CMAKE_CURRENT_LIST_DIR}/scene_families.cpp
  ${CMAKE_CURRENT_LIST_DIR}/scene_parts.cpp ${CMAKE_CURRENT_LIST_DIR}/sponge_scene.cpp)
target_link_libraries(graycube_scene_families PUBLIC graycube_scene_files)
