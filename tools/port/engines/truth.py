"""The truth about each engine's picture of each scene of the table, with the reason, from the engine's source. `rules.py` proves the numbers: a
picture is right exactly if it has no entry here. A truth has several words; a true verdict of Strata contains one of them.
"""
import dataclasses
import re


@dataclasses.dataclass(frozen=True)
class Truth:
    sentence: str
    words: str  # a regular expression

    def told_by(self, verdict):
        return re.search(self.words, verdict) is not None


UNORDERED = Truth("a weighted sum of all fragments: no order", "averaged|weighted")
AS_THEY_COME = Truth("blended as submitted, triangle by triangle", "order of submission|as they are submitted")
WRITES_DEPTH = Truth("blended as submitted, triangle by triangle, and writes depth", "write depth")
MAX_OF_TIES = Truth("fragments of equal depth become one: the greater of both, channel by channel", "merged by MAX")
ON_THE_SURFACE = Truth("a fragment on the opaque surface is drawn (LEQUAL)", "LEQUAL")
LINEAR = Truth("colours between corners are mixed in linear light", "linear|sRGB")


def left_over(peels):
    return Truth(f"{peels} peels, then what is left is blended as submitted", f"nearest {peels} layers.* order of submission")


def missing(layers):
    return Truth(f"after {layers} layers the rest, in the middle, is missing", f"nearest {layers // 2} layers and the farthest {layers // 2}")


BLENDS = ["cyclic-overlap", "woven", "inside-out", "torus", "shells"]  # several surfaces in one mesh, or meshes through each other
OPAQUE_TIES = {"decal": ON_THE_SURFACE}

WRONG = {
    ("vtk", "dual"): {"stack": left_over(4), "inside-out": left_over(4), "ties": MAX_OF_TIES, **OPAQUE_TIES,
                      "close": Truth("fragments within 1e-7 of the peeled one become one with it: the greater of both", "within .* merged by MAX"),
                      "floor": Truth("the peel ends after its first pass, as no pixel wrote a back fragment: the far end was the opaque surface. The nearest fragment alone is drawn",
                                     "only the nearest layer")},
    ("vtk", "peeling"): {**{scene: left_over(3) for scene in ("stack", "grid", "inside-out", "torus")},
                         "ties": Truth("of fragments of equal depth the last one stays", "last submitted"),
                         "close": Truth("fragments within 1e-7 behind a peeled one are lost", "within .* missing"),
                         "decal": Truth("a fragment on the opaque surface is drawn, as that depth came through 24 bits and lies behind now", "LEQUAL")},
    ("vtk", "weighted"): {scene: UNORDERED for scene in ("panes", "stack", "ties", "hidden", "decal", "close", "floor", "solid", "grid", "gradient", *BLENDS)},
    ("babylon", "oit"): {"stack": missing(10), "inside-out": missing(10), "ties": MAX_OF_TIES, **OPAQUE_TIES},
    ("babylon", "blended"): {**{scene: AS_THEY_COME for scene in BLENDS}, **OPAQUE_TIES},
    ("molstar", "dpoit"): {**{scene: missing(4) for scene in ("stack", "grid", "inside-out", "torus", "shells")}, "ties": MAX_OF_TIES},
    ("molstar", "wboit"): {scene: UNORDERED for scene in ("panes", "stack", "ties", "hidden", "decal", "close", "floor", "grid", *BLENDS)},
    ("molstar", "blended"): {scene: AS_THEY_COME for scene in ("panes", "stack", "ties", "hidden", "close", "floor", "grid", *BLENDS)},
    ("three", "blended"): {**{scene: WRITES_DEPTH for scene in BLENDS}, **OPAQUE_TIES, "gradient": LINEAR},
    ("three", "no-depth-write"): {**{scene: AS_THEY_COME for scene in BLENDS}, **OPAQUE_TIES, "gradient": LINEAR},
    ("three", "float"): {**{scene: AS_THEY_COME for scene in BLENDS}, **OPAQUE_TIES},
}
# For random scenes a rule determines where they are wrong, and this table the possible mistakes. Depths are all different there.
BY_LOT = {
    ("vtk", "dual"): Truth("4 peels, then what is left is blended as submitted; or the peel ended where all far ends were opaque", "order of submission|nearest"),
    ("vtk", "peeling"): left_over(3),
    ("vtk", "weighted"): UNORDERED, ("babylon", "oit"): missing(10),
    ("babylon", "blended"): Truth("blended by the distance of objects' centres, which is not that of depths", "order|exchanged|swapped|instances"), ("molstar", "dpoit"): missing(4),
    ("molstar", "wboit"): UNORDERED, ("molstar", "blended"): AS_THEY_COME}


def of_scene(engine, way, scene, is_wrong):
    """The Truth of a picture, None if it is right. `is_wrong` is the result of the rule, which decides for random scenes."""
    if scene.startswith("lot-"):
        return BY_LOT[engine, way] if is_wrong else None
    return WRONG[engine, way].get(scene)


# Scenes that the engine cannot render.
CANNOT = {("molstar", "gradient")}

# A wrong picture that no listed mistake explains is called wrong without a name.
UNNAMED = "no single mistake explains them all"
NOT_DECIDED = "not decided:"
JUDGMENTS = ["true", "not decided", "wrong without a name", "right called wrong without a name", "false"]


def judgment(true, status, verdict):
    """Judges Strata's verdict, given a Truth, or None for a right picture: one of JUDGMENTS. `false` is a wrong verdict without reservation."""
    if verdict.startswith(NOT_DECIDED):
        return "not decided"
    if status == 0:
        return "true" if true is None or (true.told_by(verdict) and "one depth" in verdict) else "false"
    if UNNAMED in verdict:
        return "wrong without a name" if true else "right called wrong without a name"
    return "true" if true and true.told_by(verdict) else "false"
