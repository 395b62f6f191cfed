"""What other readers take and the engine's do not, written as the engine can read it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from html import escape

from pydart2.loading.rules import Rules
from pydart2.loading.xml import Document, Element

#: Says what was done at an element, or raises.
Say = Callable[[Document, Element, str], None]

THICKNESS = 1e-3  # m, of a collision shape without: thinner ones fall through each other at time steps of 1 ms
_DRAWN = 1e-9  # m
#: The limit that stands for none.
UNBOUNDED = "1.7976931348623157e308"  # urdfdom reads no "inf"
_OWNERS = ("visual", "collision", "visualization_shape", "collision_shape")
_SHAPES = {
    "urdf": ("box", "sphere", "cylinder", "mesh", "capsule"),
    "sdf": ("box", "sphere", "cylinder", "plane", "mesh", "empty"),
    "skel": (
        *("box", "sphere", "ellipsoid", "cylinder", "capsule", "cone", "pyramid", "plane", "mesh", "multi_sphere"),
        *("soft_mesh", "heightmap", "line_segments"),
    ),
}
_EXTENTS = {"box": ("size",), "sphere": ("radius",), "cylinder": ("radius", "length", "height")}


def mend_fields(document: Document, elements: Iterable[Element], rules: Rules, say: Say) -> None:
    """Settle what the checks would refuse: a fourth number of a scale, SDF's hinges without limits and with gears."""
    for element in elements:
        if element.tag == "mesh" and document.root.tag == "robot":
            scale = (element.get("@scale") or "").split()
            if len(scale) > 3:
                say(document, element, f"{element}: its scale has {len(scale)} numbers; the first three are taken")
                document.set(element, "@scale", " ".join(scale[:3]))
        elif element.tag == "joint" and rules.kind == "sdf" and element.get("@type") == "continuous":
            document.set(element, "@type", "revolute")
            if element.find("axis", "limit") is not None:
                document.set(element, "axis/limit/lower", "-inf")
                document.set(element, "axis/limit/upper", "inf")
        elif element.tag == "joint" and rules.kind == "sdf" and element.get("@type") == "gearbox":
            gear = f"{element.get('gearbox_ratio')} to {element.get('gearbox_reference_body')!r}"
            say(
                document,
                element,
                f"{element}: the engine has no gears; it turns freely, its ratio of {gear} is left out",
            )
            document.set(element, "@type", "revolute")


def mend(
    document: Document,
    elements: Iterable[Element],
    rules: Rules,
    say: Say,
    *,
    lenient: bool,
    bounds_as_engine: bool,
) -> None:
    """Settle flat shapes, tags that are no shape, capsules of URDF, limits the wrong way round, mimics of fixed joints.

    A URDF joint without bounds has none, or with `bounds_as_engine` those of the engine, 0 and 0.
    """
    kind = "urdf" if document.root.tag == "robot" else rules.kind
    if kind not in _SHAPES:
        return
    for element in elements:
        owner = element.parent
        if element.tag == "geometry" and owner is not None and owner.tag in _OWNERS:
            _mend_geometry(document, element, owner, kind, say, lenient)
        elif element.tag == "limit":
            _mend_limit(document, element, kind, say, bounds_as_engine)
        elif element.tag == "inertial" and kind == "urdf" and element.find("mass") is None:
            say(document, element, f"{owner}: its <inertial> has no <mass>; left out")
            document.remove([element])
        elif element.tag == "mimic" and kind == "urdf" and owner is not None:
            _mend_mimic(document, element, owner, say)
        elif element.tag == "world" and kind == "sdf":
            _mend_gravity(document, element, say)


def _mend_gravity(document: Document, world: Element, say: Say) -> None:
    """Gravity stands in <physics> for the engine; since SDF 1.5 it belongs directly into <world>."""
    gravity, physics = world.get("gravity"), world.find("physics")
    if gravity is None:
        return
    inner = physics.get("gravity") if physics else None
    if physics is None:
        document.append(world, f"<physics><gravity>{gravity}</gravity></physics>".encode())
    elif inner is None:
        document.append(physics, f"<gravity>{gravity}</gravity>".encode())
    elif list(map(float, inner.split())) != list(map(float, gravity.split())):
        say(
            document,
            world,
            f"{world}: its gravity is {gravity.strip()}, that of its <physics>, {inner.strip()}, is taken",
        )


def _called(shape: Element) -> str:
    """A shape and its link, as warnings name them."""
    return f"{shape} of {shape.ancestor('link', 'body')}"


def _mend_geometry(document: Document, geometry: Element, owner: Element, kind: str, say: Say, lenient: bool) -> None:
    shape = next((child for child in geometry.children if child.tag in _SHAPES[kind]), None)
    if shape is None:
        place = geometry.children[0] if geometry.children else geometry
        what = "its <geometry> is empty" if place is geometry else f"<{place.tag}> is no shape of this format"
        reason = f"{_called(owner)}: {what}; known are {', '.join(_SHAPES[kind])}"
        if owner.tag.startswith("collision") and not lenient:
            raise document.error(place, f"{reason}; with missing_meshes='warn' it is left out")
        say(document, place, f"{reason}; left out")
        document.remove([owner])
        return
    if _mend_size(document, shape, owner, kind, say) and (kind, shape.tag) == ("urdf", "capsule"):
        _split_capsule(document, shape, owner)


def _mend_size(document: Document, shape: Element, owner: Element, kind: str, say: Say) -> bool:
    """Give an extent of zero the least that the engine takes; whether the shape stays: a collision point does not."""
    collides = owner.tag.startswith("collision")
    for name in _EXTENTS.get(shape.tag, ()):
        field = f"@{name}" if kind == "urdf" else name
        sizes = [float(word) for word in (shape.get(field) or "").split()]
        if any(size < 0.0 for size in sizes):
            raise document.error(shape, f"{_called(owner)}: {name} must not be negative, got {shape.get(field)!r}")
        if 0.0 not in sizes:
            continue
        if collides and shape.tag == "sphere":
            say(document, shape, f"{_called(owner)} is a point: it does not collide")
            document.remove([owner])
            return False
        least = (THICKNESS / 2 if name == "radius" else THICKNESS) if collides else _DRAWN
        if collides:
            say(document, shape, f"{_called(owner)} has no thickness: {THICKNESS} m for collisions")
        document.set(shape, field, " ".join(repr(size or least) for size in sizes))
    return True


def _split_capsule(document: Document, capsule: Element, owner: Element) -> None:
    """A capsule, which the engine's URDF reader has not, is a cylinder along z and a sphere at each end."""
    radius, length = (float(capsule.get(field) or 0.0) for field in ("@radius", "@length"))
    if radius <= 0.0 or length < 0.0:
        raise document.error(capsule, f"{_called(owner)}: a capsule needs a radius above 0 and a length")
    origin = owner.find("origin")
    xyz, rpy = ([float(x) for x in ((origin.get(f) if origin else None) or "0 0 0").split()] for f in ("@xyz", "@rpy"))
    axis = _z_axis(*rpy)
    material = owner.find("material")
    colour = document.data[material.start : material.end].decode() if material else ""
    for half in (length / 2.0, -length / 2.0):
        place = " ".join(repr(x + half * a) for x, a in zip(xyz, axis, strict=True))
        geometry = f"<geometry><sphere radius='{radius!r}'/></geometry>"
        sphere = f"<{owner.tag}><origin xyz='{place}'/>{geometry}{colour}</{owner.tag}>"
        document.append(owner.parent or owner, sphere.encode())
    if length > 0.0:
        document.append(capsule.parent or owner, f"<cylinder radius='{radius!r}' length='{length!r}'/>".encode())
        document.remove([capsule])
    else:
        document.remove([owner])


def mirror(document: Document, mesh: Element, path: str) -> bool:
    """Name the mirrored file of a mesh whose scale is negative, with the scale's absolute; whether it was.

    The engine takes no negative scale; mirror-x:///path is the file mirrored along x (shared_scenes.hpp).
    """
    fields = ("@filename", "@scale") if document.root.tag == "robot" else ("file_name", "scale")
    fields = ("uri", "scale") if document.root.tag == "sdf" else fields
    scales = (mesh.get(fields[1]) or "").split()
    axes = "".join(axis for axis, scale in zip("xyz", scales, strict=False) if float(scale) < 0.0)
    if not axes or document.root.tag == "mujoco":
        return False
    document.set(mesh, fields[0], escape(f"mirror-{axes}://{path}"))
    document.set(mesh, fields[1], " ".join(repr(abs(float(scale))) for scale in scales))
    return True


def _z_axis(roll: float, pitch: float, yaw: float) -> tuple[float, float, float]:
    """Where URDF's rpy take the z axis."""
    return (
        math.cos(yaw) * math.sin(pitch) * math.cos(roll) + math.sin(yaw) * math.sin(roll),
        math.sin(yaw) * math.sin(pitch) * math.cos(roll) - math.cos(yaw) * math.sin(roll),
        math.cos(pitch) * math.cos(roll),
    )


def infinite_limit(sign: float) -> str:
    """How URDF says that a limit is inf or -inf."""
    return UNBOUNDED if sign > 0.0 else "-" + UNBOUNDED


def _mend_limit(document: Document, limit: Element, kind: str, say: Say, bounds_as_engine: bool) -> None:
    """Bounds the wrong way round are none; in URDF, neither are two that are not there, nor effort and velocity."""
    joint = limit.ancestor("joint")
    fields = ("@lower", "@upper") if kind == "urdf" else ("lower", "upper")
    lower, upper = (limit.get(field) for field in fields)
    if joint is None:
        return
    if kind == "urdf" and (missing := [name for name in ("effort", "velocity") if limit.get(f"@{name}") is None]):
        say(document, limit, f"{joint}: its <limit> has no {' and no '.join(missing)}; there is no such limit")
        for name in missing:
            document.set(limit, f"@{name}", UNBOUNDED)
    for name in ("lower", "upper", "effort", "velocity") if kind == "urdf" else ():
        if math.isinf(number := float(limit.get(f"@{name}") or 0.0)):
            document.set(limit, f"@{name}", infinite_limit(number))
    if lower is not None and upper is not None:
        if float(lower) <= float(upper):
            return
        say(document, limit, f"{joint}: its lower limit, {lower}, is above its upper, {upper}; it has none")
    elif kind != "urdf" or (lower, upper) != (None, None) or bounds_as_engine:
        return
    if kind != "urdf":
        for field, value in zip(fields, ("-inf", "inf"), strict=True):
            document.set(limit, field, value)
    elif joint.get("@type") == "revolute":
        document.set(joint, "@type", "continuous")
    elif joint.get("@type") == "prismatic":
        document.set(limit, "@lower", "-" + UNBOUNDED)
        document.set(limit, "@upper", UNBOUNDED)


def _mend_mimic(document: Document, mimic: Element, joint: Element, say: Say) -> None:
    """A joint that is fixed, or that follows one that is, has nothing to follow."""
    leaders = (child for child in document.root.children if child.tag == "joint")
    leader = next((child for child in leaders if child.get("@name") == mimic.get("@joint")), None)
    if joint.get("@type") == "fixed":
        document.remove([mimic])
    elif leader is not None and leader.get("@type") == "fixed":
        say(document, mimic, f"{joint} mimics {leader}, which is fixed: it moves by itself")
        document.remove([mimic])
