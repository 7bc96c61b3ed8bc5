#!/usr/bin/env python3
"""Computes pixels of a scene of spheres and half-spaces by docs/shading.md and docs/scene.md alone.

    python3 tests/golden/shading_models.py SCENE WIDTH HEIGHT X,Y ...

prints a line "X Y R G B" for each pixel, with one ray through its centre. It shares nothing with
the engine: shading_models_test.cpp holds what it printed, and compares.
"""
import cmath
import json
import math
import sys

WHITE = (1.0, 1.0, 1.0)


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def mul(a, b):
    return tuple(x * y for x, y in zip(a, b))


def scale(s, a):
    return tuple(s * x for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scale(1 / math.sqrt(dot(a, a)), a)


def by_colour(value):
    return tuple(value) if isinstance(value, list) else (value, value, value)


class Material:
    def __init__(self, m):
        self.model = m.get("model", "phong")
        self.is_fresnel = self.model != "phong"
        self.color = tuple(m.get("color", WHITE))
        self.ambient = m.get("ambient", 0.1)
        self.diffuse = m.get("diffuse", 0.9)
        self.specular = m.get("specular", 0)
        self.shininess = m.get("shininess", 1)
        self.reflect = m.get("reflect", 0)
        self.transmit = m.get("transmit", 0)
        self.ior = by_colour(m.get("ior", 1.5 if self.is_fresnel else 1))
        self.absorption = by_colour(m.get("absorption", 0))
        self.attenuation = by_colour(m.get("attenuation", 0))
        self.roughness = m.get("roughness", 0.2)
        self.transmit_shininess = m.get("transmit_shininess", self.shininess)
        self.pattern = m.get("pattern")

    def colour_at(self, p):
        if self.pattern is None:
            return self.color
        for step in self.pattern.get("to_pattern", []):
            p = add(p, step["translate"])  # no scene of ours has other maps
        return tuple(self.pattern["colors"][sum(math.floor(v) for v in p) % 2])

    def mirrored(self, cosine, is_within):
        """Fresnel's equations in complex numbers, for each colour."""
        result = []
        for n, k in zip(self.ior, self.absorption):
            index = complex(n, k)
            if is_within and k == 0:
                index = 1 / index
            beyond = cmath.sqrt(index * index - (1 - cosine * cosine))  # index · cos of refraction
            across = (cosine - beyond) / (cosine + beyond)
            along = (index * index * cosine - beyond) / (index * index * cosine + beyond)
            result.append((abs(across) ** 2 + abs(along) ** 2) / 2)
        return tuple(result)


class Sphere:
    def __init__(self, csg):
        self.center, self.radius = tuple(csg["center"]), csg["radius"]

    def crossings(self, o, d):
        m = sub(o, self.center)
        b, c = dot(m, d), dot(m, m) - self.radius ** 2
        if b * b <= c:
            return []
        root = math.sqrt(b * b - c)
        return [(-b - root, True), (-b + root, False)]

    def normal(self, p):
        return scale(1 / self.radius, sub(p, self.center))


class HalfSpace:
    def __init__(self, csg):
        self.n, self.offset = unit(csg["normal"]), csg["offset"]

    def crossings(self, o, d):
        fall = dot(self.n, d)
        if fall == 0:
            return []
        return [((self.offset - dot(self.n, o)) / fall, fall < 0)]

    def normal(self, _):
        return self.n


class Scene:
    def __init__(self, text):
        s = json.loads(text)
        self.camera = s["camera"]
        self.background = tuple(s["background"])
        self.ambient = tuple(s.get("ambient", WHITE))
        self.max_depth = s.get("max_depth", 5)
        self.lights = s["lights"]
        materials = {name: Material(m) for name, m in s["materials"].items()}
        kinds = {"sphere": Sphere, "half_space": HalfSpace}
        self.objects = [(kinds[o["csg"]["type"]](o["csg"]), materials[o["material"]])
                        for o in s["objects"]]

    def first(self, o, d, start):
        found = None
        for solid, material in self.objects:
            for t, entering in solid.crossings(o, d):
                if t >= start and (found is None or t < found[0]):
                    found = (t, entering, solid, material)
        return found

    def passing(self, o, d, start, end):
        """The part of light that arrives from a distance of `end`."""
        part = 1.0
        for solid, material in self.objects:
            for t, _ in solid.crossings(o, d):
                if start <= t < end:
                    part *= material.transmit
        return part

    def light(self, o, d, start, depth, medium, is_primary=False):
        """What a ray brings; `medium` is the material in which it is, or None."""
        hit = self.first(o, d, start)
        if hit is None:
            return mul(self.background, dimmed(medium, math.inf))
        t, entering, solid, m = hit
        if is_primary and not entering:
            medium = m
        return mul(dimmed(medium, t), self.shade(add(o, scale(t, d)), d, hit, depth, medium))

    def shade(self, p, d, hit, depth, medium):
        _, entering, solid, m = hit
        n = solid.normal(p)
        n = scale(-1, n) if dot(n, d) > 0 else n
        v, epsilon = scale(-1, d), 1e-9 * max(1, *(abs(x) for x in p))
        colour = m.colour_at(p)
        total = scale(m.ambient * (1 - m.transmit), mul(colour, self.ambient))
        for light in self.lights:
            way = sub(light["position"], p)
            distance = math.sqrt(dot(way, way))
            l = scale(1 / distance, way)
            share = highlight(m, n, v, l, not entering)
            if dot(n, l) > 0:
                share = add(share, scale(m.diffuse * dot(n, l) * (1 - m.transmit), colour))
            if max(share) > 0:
                part = self.passing(p, l, epsilon, distance - epsilon)
                total = add(total, scale(part, mul(light["color"], share)))
        if depth == self.max_depth:
            return total
        for weight, direction, inside in secondary(m, n, d, entering):
            if max(weight) > 0:
                then = (m if entering else None) if inside else medium
                total = add(total, mul(weight, self.light(p, direction, epsilon, depth + 1, then)))
        return total


def dimmed(medium, distance):
    if medium is None:
        return WHITE
    return tuple(1.0 if a == 0 else math.exp(-a * distance) for a in medium.attenuation)


def highlight(m, n, v, l, is_within):
    if m.specular == 0:
        return (0, 0, 0)
    if dot(n, l) < 0:
        return highlight_from_behind(m, n, v, l, is_within)
    if m.model == "phong":
        r = sub(scale(2 * dot(v, n), n), v)
        return by_colour(m.specular * max(0, dot(r, l)) ** m.shininess)
    h = unit(add(l, v))
    mirrored = m.mirrored(dot(v, h), is_within)
    if m.model == "hall_greenberg":
        return scale(m.specular * dot(n, h) ** m.shininess, mirrored)
    facets = math.exp(-(math.acos(min(1, dot(n, h))) / m.roughness) ** 2)
    grooves = min(1, 2 * dot(n, h) * dot(n, v) / dot(v, h), 2 * dot(n, h) * dot(n, l) / dot(v, h))
    return scale(m.specular * facets * grooves / (4 * m.roughness ** 2 * dot(n, v)), mirrored)


def highlight_from_behind(m, n, v, l, is_within):
    if m.model != "hall_greenberg" or m.transmit == 0:
        return (0, 0, 0)
    before, behind = (m.ior[0], 1) if is_within else (1, m.ior[0])
    h = unit(add(scale(behind, l), scale(before, v)))
    h = scale(-1, h) if dot(h, v) < 0 else h
    if dot(h, l) >= 0 or dot(n, h) <= 0:
        return (0, 0, 0)
    passing = sub(WHITE, m.mirrored(dot(v, h), is_within))
    return scale(m.specular * m.transmit * dot(n, h) ** m.transmit_shininess, passing)


def secondary(m, n, d, entering):
    """Weight, direction, and whether it goes on behind the surface, of each secondary ray."""
    cosine = -dot(n, d)
    r = add(d, scale(2 * cosine, n))
    mirrored = m.mirrored(cosine, not entering) if m.is_fresnel else WHITE
    passing = sub(WHITE, mirrored) if m.is_fresnel else WHITE
    rays = []
    if m.transmit > 0:
        eta = 1 / m.ior[0] if entering else m.ior[0]
        k = 1 - eta * eta * (1 - cosine * cosine)
        if k < 0:
            return [(by_colour(max(m.reflect, m.transmit) if m.is_fresnel else 1), r, False)]
        through = unit(add(scale(eta, d), scale(eta * cosine - math.sqrt(k), n)))
        rays.append((scale(m.transmit, passing), through, True))
    if m.reflect > 0:
        rays.append((scale(m.reflect, mirrored), r, False))
    return rays


def primary_ray(camera, width, height, x, y):
    forward = unit(sub(camera["look_at"], camera["eye"]))
    right = unit(cross(camera["up"], forward))
    up = cross(forward, right)
    if camera.get("handedness", "right") == "right":
        right = scale(-1, right)
    half = math.tan(math.radians(camera["fov"] / 2))
    across = ((x + 0.5) / width * 2 - 1) * half
    upwards = (1 - (y + 0.5) / height * 2) * half * height / width
    return tuple(camera["eye"]), unit(add(forward, add(scale(across, right), scale(upwards, up))))


def main():
    path, width, height = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    with open(path, encoding="utf-8") as file:
        scene = Scene(file.read())
    for place in sys.argv[4:]:
        x, y = (int(v) for v in place.split(","))
        o, d = primary_ray(scene.camera, width, height, x, y)
        print(x, y, *(f"{v:.12f}" for v in scene.light(o, d, 0, 0, None, True)))


if __name__ == "__main__":
    main()
