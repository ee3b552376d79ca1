"""Files that ask for one error code of the validator each, where chance seldom does."""
import base64
import copy
import json
import struct

from models import as_glb, data_uri, everything, png, triangle


def of(document, *changes):
    """A copy with values set at pointers written a.0.b; lists grow by one behind their end, and missing objects come into being."""
    document = copy.deepcopy(document)
    for pointer, value in changes:
        place, keys = document, pointer.split(".")
        for key in keys[:-1]:
            if isinstance(place, list):
                place = place[int(key)]
            else:
                place = place.setdefault(key, {})
        if isinstance(place, list) and int(keys[-1]) == len(place):
            place.append(value)
        else:
            place[int(keys[-1]) if isinstance(place, list) else keys[-1]] = value
    return json.dumps(document).encode()


def with_data(document, fmt, at, *numbers):
    """Other numbers at a byte of the buffer."""
    data = bytearray(base64.b64decode(document["buffers"][0]["uri"].split(",")[1]))
    struct.pack_into("<" + fmt, data, at, *numbers)
    return of(document, ("buffers.0.uri", data_uri(bytes(data))))


def with_chunks(document, *kinds):
    """Chunks of four bytes each behind the first; a kind that is empty stands for a chunk of none."""
    body = b"".join(struct.pack("<I", 4) + kind + bytes(4) if kind else struct.pack("<I", 0) + b"BIN\0" for kind in kinds)
    glb = as_glb(document)
    return glb[:8] + struct.pack("<I", len(glb) + len(body)) + glb[12:] + body


def views(document):
    return [view["byteOffset"] for view in document["bufferViews"]]


def targeted():
    full, small = everything(), triangle()
    at = views(full)
    part = "meshes.0.primitives.0."
    broken = png()[:40]
    files = {
        "DUPLICATE_ELEMENTS": of(full, ("scenes.0.nodes", [0, 0])),
        "INVALID_JSON": b'{"asset": {"version": "2.0"}, ',
        "IO_ERROR": of(small, ("buffers.0.uri", "missing.bin")),
        "PATTERN_MISMATCH": of(small, ("asset.version", "two")),
        "VALUE_MULTIPLE_OF": of(small, ("bufferViews.0.byteStride", 14)),
        "ACCESSOR_NORMALIZED_INVALID": of(full, ("accessors.0.normalized", True)),
        "ACCESSOR_OFFSET_ALIGNMENT": of(full, ("accessors.0.byteOffset", 2), ("accessors.0.count", 3)),
        "ACCESSOR_MATRIX_ALIGNMENT": of(full, ("accessors.6", {"bufferView": 0, "componentType": 5121, "type": "MAT2", "count": 1, "byteOffset": 2})),
        "ASSET_MIN_VERSION_GREATER_THAN_VERSION": of(small, ("asset.minVersion", "2.1")),
        "BUFFER_DATA_URI_MIME_TYPE_INVALID": of(small, ("buffers.0.uri", small["buffers"][0]["uri"].replace("application/octet-stream", "text/plain"))),
        "BUFFER_VIEW_INVALID_BYTE_STRIDE": of(small, ("bufferViews.0.byteStride", 6)),
        "BUFFER_VIEW_TOO_BIG_BYTE_STRIDE": of(small, ("bufferViews.0.byteStride", 252)),
        "CAMERA_XMAG_YMAG_ZERO": of(full, ("cameras.1.orthographic.xmag", 0)),
        "CAMERA_ZFAR_LEQUAL_ZNEAR": of(full, ("cameras.0.perspective.zfar", 0.05)),
        "INVALID_GL_VALUE": of(full, ("samplers.0.wrapS", 10496)),
        "MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY": of(full, (part + "attributes.TEXCOORD_2", 2)),
        "NODE_MATRIX_TRS": of(full, ("nodes.2.translation", [1, 0, 0])),
        "NON_REQUIRED_EXTENSION": of(full, ("extensionsUsed.2", "KHR_mesh_quantization")),
        "UNKNOWN_ASSET_MAJOR_VERSION": of(small, ("asset.version", "3.0")),
        "UNUSED_EXTENSION_REQUIRED": of(full, ("extensionsRequired", ["KHR_mesh_quantization"])),
        "ACCESSOR_SMALL_BYTESTRIDE": of(small, ("bufferViews.0.byteStride", 8)),
        "ACCESSOR_TOTAL_OFFSET_ALIGNMENT": of(full, ("bufferViews.0.byteOffset", 2), ("bufferViews.0.byteLength", 46)),
        "BUFFER_MISSING_GLB_DATA": as_glb({**small, "buffers": [{"byteLength": 36}]}),
        "IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE": of(full, ("bufferViews.7.byteStride", 4)),
        "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT": of(full, ("accessors.6", {"bufferView": 3, "componentType": 5125, "type": "SCALAR", "count": 4}),
                                                              (part + "attributes._NUMBER", 6)),
        "MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE": of(full, ("bufferViews.4.byteStride", 4), ("accessors.4.count", 3)),
        "MESH_PRIMITIVE_TOO_FEW_TEXCOORDS": of(full, ("materials.0.pbrMetallicRoughness.baseColorTexture.texCoord", 1)),
        "NODE_LOOP": of(full, ("nodes.1.children", [0])),
        "NODE_PARENT_OVERRIDE": of(full, ("nodes.1.children", [2])),
        "SCENE_NON_ROOT_NODE": of(full, ("scenes.0.nodes", [1])),
        "TEXTURE_INVALID_IMAGE_MIME_TYPE": of(full, ("images.0.mimeType", "image/webp")),
        "UNEXPECTED_EXTENSION_OBJECT": of(full, ("nodes.0.extensions", {"KHR_materials_unlit": {}})),
        "ACCESSOR_INDEX_OOB": with_data(full, "H", at[4], 9),
        "ACCESSOR_INDEX_PRIMITIVE_RESTART": with_data(full, "H", at[4], 65535),
        "ACCESSOR_INVALID_FLOAT": with_data(full, "f", at[1], float("nan")),
        "ACCESSOR_INVALID_FLOAT-position": with_data(full, "f", at[0], float("inf")),
        "ACCESSOR_VECTOR3_NON_UNIT": with_data(full, "3f", at[1], 3, 0, 0),
        "ACCESSOR_NON_CLAMPED": of(json.loads(with_data(full, "3f", at[1], 3, 0, 0)), (part + "attributes.COLOR_0", 1)),
        "GLB_LENGTH_TOO_SMALL": as_glb(small, length=8),
        "GLB_UNEXPECTED_BIN_CHUNK": with_chunks(small, b"ABCD", b"BIN\0"),
        "GLB_EMPTY_CHUNK": with_chunks(small, b"", b"ABCD"),
        "ACCESSOR_SPARSE_INDEX_OOB": with_data(full, "B", at[5] + 3, 200),
        "ACCESSOR_SPARSE_INDICES_NON_INCREASING": with_data(full, "4B", at[5], 2, 1, 0, 3),
        "ACCESSOR_INVALID_SIGN": of(full, (part + "attributes.TANGENT", 3)),
        "BUFFER_BYTE_LENGTH_MISMATCH": of(small, ("buffers.0.byteLength", 60)),
        "BUFFER_GLB_CHUNK_TOO_BIG": as_glb({**small, "buffers": [{"byteLength": 36}]}, binary=b"\0" * 80),
        "IMAGE_DATA_INVALID": of(full, ("images.1.uri", data_uri(png()[:11] + b"\x0c" + png()[12:], "image/png"))),
        "IMAGE_UNEXPECTED_EOS": of(full, ("images.1.uri", data_uri(broken, "image/png")), ("textures.0.source", 1)),
        "IMAGE_MIME_TYPE_INVALID": of(full, ("images.0.mimeType", "image/jpeg")),
        "IMAGE_UNRECOGNIZED_FORMAT": of(full, ("images.1.uri", data_uri(b"GIF89a" + bytes(60), "image/png")), ("textures.0.source", 1)),
        "MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS": of(small, ("accessors.0", {k: v for k, v in small["accessors"][0].items() if k not in ("min", "max")})),
        "MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT": of(full, (part + "targets", [{"POSITION": 0}])),
        "VALUE_NOT_IN_RANGE": of(full, ("accessors.0.count", 0)),
    }
    for name, data in files.items():
        yield f"{name}.{'glb' if data.startswith(b'glTF') else 'gltf'}", data
