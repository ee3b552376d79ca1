"""What is true of each engine's picture of each scene of the table, and why, told from the engine's source. `rules.py` proves the numbers:
a picture is right exactly where nothing stands here.
"""
UNORDERED = "a weighted sum of all fragments: no order"
AS_THEY_COME = "blended as submitted, triangle by triangle"
MAX_OF_TIES = "fragments of equal depth become one: the greater of both, channel by channel"
ON_THE_SURFACE = "a fragment on the opaque surface is drawn (LEQUAL)"
LEFT_OVER = "{} peels, then what is left is blended as submitted"
MISSING = "after {} layers the rest, in the middle, is missing"

BLENDS = ["cyclic-overlap", "woven", "inside-out", "torus", "shells"]  # several surfaces in one mesh, or meshes through each other
OPAQUE_TIES = {"decal": ON_THE_SURFACE}

WRONG = {
    ("vtk", "dual"): {"stack": LEFT_OVER.format(4), "inside-out": LEFT_OVER.format(4), "ties": MAX_OF_TIES, **OPAQUE_TIES,
                      "close": "fragments within 1e-7 of the peeled one become one with it: the greater of both",
                      "floor": "the peel ends after its first pass, as no pixel wrote a back fragment: the far end was the opaque surface. The nearest fragment alone is drawn"},
    ("vtk", "peeling"): {**{scene: LEFT_OVER.format(3) for scene in ("stack", "grid", "inside-out", "torus")},
                         "ties": "of fragments of equal depth the last one stays", "close": "fragments within 1e-7 behind a peeled one are lost",
                         "decal": "a fragment on the opaque surface is drawn, as that depth came through 24 bits and lies behind now"},
    ("vtk", "weighted"): {scene: UNORDERED for scene in ("panes", "stack", "ties", "hidden", "decal", "close", "floor", "solid", "grid", "gradient", *BLENDS)},
    ("babylon", "oit"): {"stack": MISSING.format(10), "inside-out": MISSING.format(10), "ties": MAX_OF_TIES, **OPAQUE_TIES},
    ("babylon", "blended"): {**{scene: AS_THEY_COME for scene in BLENDS}, **OPAQUE_TIES},
    ("molstar", "dpoit"): {**{scene: MISSING.format(4) for scene in ("stack", "grid", "inside-out", "torus", "shells")}, "ties": MAX_OF_TIES},
    ("molstar", "wboit"): {scene: UNORDERED for scene in ("panes", "stack", "ties", "hidden", "decal", "close", "floor", "grid", *BLENDS)},
    ("molstar", "blended"): {scene: AS_THEY_COME for scene in ("panes", "stack", "ties", "hidden", "close", "floor", "grid", *BLENDS)},
    ("three", "blended"): {**{scene: AS_THEY_COME + ", and writes depth" for scene in BLENDS}, **OPAQUE_TIES,
                           "gradient": "colours between corners are mixed in linear light"},
    ("three", "no-depth-write"): {**{scene: AS_THEY_COME for scene in BLENDS}, **OPAQUE_TIES, "gradient": "colours between corners are mixed in linear light"},
    ("three", "float"): {**{scene: AS_THEY_COME for scene in BLENDS}, **OPAQUE_TIES},
}
# What an engine cannot draw.
CANNOT = {("molstar", "gradient")}
