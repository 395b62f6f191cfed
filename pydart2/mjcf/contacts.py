"""Which bodies of a compiled model collide: MuJoCo's filter as ours."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from pydart2._native import WorldHandle
from pydart2.mjcf.compile import Compiled
from pydart2.mjcf.trees import Built


def set_filter(model: Compiled, world: WorldHandle, built: Built, mixed: set[str]) -> None:
    """Let those bodies pass through each other that MuJoCo lets; notes in `mixed` where geoms of a pair differ."""
    excluded = {(int(s) >> 16, int(s) & 0xFFFF) for s in model.exclude_signature}
    masks = {body: _masks(model, body) for body in built.places}
    by_node: dict[tuple[int, int], list[int]] = {}
    for body, node in built.places.items():
        if len(masks[body]):
            by_node.setdefault(node, []).append(body)
    never, within = [], set()
    for (a, bodies_a), (b, bodies_b) in combinations(by_node.items(), 2):
        pairs = [(i, j) for i in bodies_a for j in bodies_b]
        open_pairs = [p for p in pairs if not _filtered(model, *p, excluded)]
        hits = [hit for i, j in open_pairs for hit in _hits(masks[i], masks[j])]
        if any(hits) and (not all(hits) or len(open_pairs) < len(pairs)):
            mixed.add("contype and conaffinity that differ among the geoms of a body")
        if any(hits) and a[0] == b[0]:
            within.add(a[0])
        if not any(hits):
            never.append((a, b))
    for skeleton in within:
        world.skeleton(skeleton).set_self_collision_check(True)
        world.skeleton(skeleton).set_adjacent_body_check(True)
    for a, b in never:
        if a[0] != b[0] or a[0] in within:
            world.ignore_pairs(np.array([a], dtype=float), np.array([b], dtype=float), True)


def _masks(model: Compiled, body: int) -> list[tuple[int, int]]:
    first = int(model.body_geomadr[body])
    geoms = range(first, first + int(model.body_geomnum[body]))
    masks = {(int(model.geom_contype[geom]), int(model.geom_conaffinity[geom])) for geom in geoms}
    return sorted(masks - {(0, 0)})


def _hits(a: list[tuple[int, int]], b: list[tuple[int, int]]) -> list[bool]:
    return [bool(i[0] & j[1] or j[0] & i[1]) for i in a for j in b]


def _filtered(model: Compiled, a: int, b: int, excluded: set[tuple[int, int]]) -> bool:
    """Whether MuJoCo never tests the two: excluded, of one welded piece, or one welded to the other's parent."""
    if (a, b) in excluded or (b, a) in excluded:
        return True
    weld = model.body_weldid
    if weld[a] == weld[b]:
        return True
    above = [int(weld[model.body_parentid[weld[body]]]) for body in (a, b)]
    return bool((above[1] == weld[a] and weld[a] != 0) or (above[0] == weld[b] and weld[b] != 0))
