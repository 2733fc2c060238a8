"""Small nasty files from other loaders' test suites, if they are available: each ends as documented.

Called with the binary and the folder of shared scenes."""

import glob
import os
import sys
import unittest

NASTY = os.path.join(os.path.abspath(sys.argv.pop(2)), "nasty")

from scene_case import SceneCase  # noqa: E402, it takes the binary off the arguments

NO_LIBRARY = "use materials that no MTL file defines"
# The warnings of each file; errors are listed separately.
TOLD = {
    "concave_10gon/issue-319-003.obj": [],
    "duplicate_vertices/duplicatevertices.obj": ["1 edges belong to more than two triangles (non-manifold)"],
    "malformed_faces/malformed2.obj": ["1 faces of fewer than three corners", "10 triangles " + NO_LIBRARY],
    "missing_attributes/box-missing-attributes.obj": ["24 texture coordinate indices lead nowhere",
                                                      "24 normal indices lead nowhere"],
    "missing_mtl/missing_material_file.obj": ["36 triangles " + NO_LIBRARY + " ('white')"],
    "missing_texture/box-missing-texture.obj": ["1 texture files are missing ('/cesium.png')"],
    "mtllib_list/mtllib-multiple-files-issue-112.obj": ["1 texture files are missing", "2 material files are missing"],
    "negative_indices_vn/negative_indices.obj": [],
    "no_final_newline/box_without_lineending.obj": ["12 triangles " + NO_LIBRARY],
    "objects_groups_materials/box-objects-groups-materials.obj": [],
    "points_lines_quads/testmixed.obj": ["12 triangles " + NO_LIBRARY],
    "quad_knot/quadknot.obj": ["1 material files are missing", "2880 triangles " + NO_LIBRARY],
    "texture_options/texture-options-issue-85.obj": ["9 texture files are missing ('ambient.jpg', 'diffuse.jpg', "],
    "transparent_box/box-transparent.obj": [],
    "usemtl_before_o/issue-235-usemtl-then-o.obj": [],
    "vertex_colours/cube-vertexcol.obj": [],
}
REFUSED = {
    "index_past_end/invalid_index.obj": "invalid_index.obj:12: a face uses vertex 7, but the file has 6 vertices",
    "invalid_faces/invalid-face-definition.obj": "none of its 2 faces has three corners",
    "relative_texture_index/invalid-relative-texture-index.obj": "-index.obj:2: a face uses vertex 1",
}


@unittest.skipUnless(os.path.isdir(NASTY), f"{NASTY} is not here")
class NastyScenesTest(SceneCase):
    def test_all_are_known(self):
        found = {os.path.relpath(path, NASTY) for path in glob.glob(NASTY + "/*/*.obj")}
        self.assertEqual(found, TOLD.keys() | REFUSED.keys())

    def test_drawn_with_their_warnings(self):
        for name, says in TOLD.items():
            with self.subTest(name):
                rows, lines = self.picture(os.path.join(NASTY, name))
                lines = [line for line in lines if "are not read yet" not in line]
                self.assertEqual(len(lines), len(says), lines)
                for line, part in zip(lines, says):
                    self.assertIn(part, line)
                self.assertGreater(len({bytes(row) for row in rows}), 1, "nothing but background")

    def test_refused(self):
        for name, says in REFUSED.items():
            with self.subTest(name):
                self.refuse(os.path.join(NASTY, name), says)


if __name__ == "__main__":
    unittest.main()
