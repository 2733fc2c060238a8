"""Files as people have them, where they are at hand: one test per folder, each holding what its README expects.

Called with the binary and the folder of shared scenes."""

import os
import shutil
import sys
import unittest

FIELD = os.path.join(os.path.abspath(sys.argv.pop(2)), "field")

from cli_test_case import Png  # noqa: E402
from scene_case import SceneCase  # noqa: E402, it takes the binary off the arguments


@unittest.skipUnless(os.path.isdir(FIELD), f"{FIELD} is not here")
class FieldCase(SceneCase):
    def told(self, name, *says):
        """The picture of a file of the field, with these warnings and no others."""
        rows, lines = self.picture(os.path.join(FIELD, name))
        self.assertEqual(len(lines), len(says), lines)
        for line, part in zip(lines, says):
            self.assertIn(part, line)
        return rows

    def plain(self, name, mtl, statements, more=()):
        """The picture of a copy whose MTL says only this, without a word. `more`: folders that belong to it."""
        folder = os.path.dirname(os.path.join(FIELD, name))
        shutil.copytree(folder, self.path("copy"), dirs_exist_ok=True)
        self.write(os.path.join("copy", mtl), statements)
        return self.fine(os.path.join("copy", os.path.basename(name)))


class OpacityTest(FieldCase):
    def test_maya_illum4(self):
        told = "1 materials say illum 4 or 9 but have a colour and no Tf below 1, and are drawn opaque ('m')"
        textured = self.told("maya_illum4/textured.obj", told)
        self.assertEqual(textured, self.told("maya_illum4/plain.obj"))
        lambert = self.told("maya_illum4/lambert.obj", told)
        self.assertEqual(lambert, self.plain("maya_illum4/lambert.obj", "lambert.mtl", "newmtl m\nKd .8 .2 .2\n"))

    def test_maya_illum4_that_is_glass(self):
        path = os.path.join(FIELD, "maya_illum4", "lambert.obj")
        self.write("glass.json", f'{{"meshes": ["{path}"], "glass": ["m"]}}')
        self.assertEqual([m["kind"] for m in self.report("glass.json")["materials"]], ["glass"])
        self.fine("glass.json")
        self.write("wrong.json", f'{{"meshes": ["{path}"], "opaque": ["n"]}}')
        self.refuse("wrong.json", "opaque: no MTL file of its meshes defines the material 'n'")

    def test_tr1_meshlab_openmvs(self):
        opaque = self.plain("tr1_meshlab_openmvs/openmvs.obj", "openmvs.mtl", "newmtl m\nKd 1 1 1\nmap_Kd tex4.png\n")
        names = [name for name in os.listdir(os.path.join(FIELD, "tr1_meshlab_openmvs")) if name.endswith(".obj")]
        for name in names:
            rows = self.told("tr1_meshlab_openmvs/" + name, "1 materials say Tr 1 and no d, and are drawn opaque ('m')")
            if name == "openmvs.obj":
                self.assertEqual(rows, opaque)

    def test_texture_alpha_unused(self):
        folder, opaque = "texture_alpha_unused/", "1 textures have an alpha of 0 in every texel, which was taken as opaque"
        bmp, png = self.told(folder + "x_t32_bmp.obj"), self.told(folder + "x_t_alpha0_png.obj", opaque)
        for rows in (bmp, png):
            self.assertGreater(len({tuple(row[3 * x:3 * x + 3]) for row in rows for x in range(32)}), 8, "a texture")
        self.told(folder + "x_t_alphahalf_png.obj", "all its 12 triangles are invisible (its texture is all holes)",
                  "frame 1 shows nothing")

    def test_invisible_d0(self):
        self.told("invisible_d0/m_d0.obj", "material 'm': all its 12 triangles are invisible (d 0)")


class TextureTest(FieldCase):
    def textured(self, name, *says):
        rows = self.told(name, *says)
        self.assertRegex(self.report(os.path.join(FIELD, name))["files"][-1], r"\.(png|PNG)$")
        self.assertGreater(len({tuple(row[3 * x:3 * x + 3]) for row in rows for x in range(32)}), 8, "a texture")
        return rows

    def test_texture_case(self):
        self.textured("texture_case/x_case.obj", "1 texture names lead to no file as written")

    def test_texture_name_forms(self):
        folder = "texture_name_forms/"
        quoted = self.textured(folder + "m_quoted.obj", "1 texture names lead to no file as written")
        self.assertEqual(quoted, self.textured(folder + "x_mapKD.obj"))
        self.textured(folder + "x_mapD.obj")
        empty = self.told(folder + "x_emptysp.obj")
        self.assertEqual(empty, self.plain(folder + "x_emptysp.obj", "x_emptysp.mtl", "newmtl m\nKd 1 1 1\n"))

    def test_texture_path_from_obj(self):
        self.textured("texture_path_from_obj/m_subrelobj.obj")

    def test_parent_folder_texture(self):
        for name in ("id/models/model_normalized.obj", "ml/a/x.obj", "ml/a/y.obj"):
            self.textured("parent_folder_texture/" + name)


class ColourTest(FieldCase):
    def note(self, name, *says):
        """What `inspect` and `render` say without a warning, and the picture."""
        path = os.path.join(FIELD, name)
        self.assertEqual(len(self.report(path)["notes"]), len(says))
        spoken = self.succeed("render", path, "--size", "8x8", "--method", "raytrace", "-o", "p.png").stderr
        for note, part in zip(self.report(path)["notes"], says):
            self.assertIn(part, note)
            self.assertIn(note, spoken)
        return self.told(name)

    def test_colours_silent(self):
        folder = "colours_silent/"
        pictures = [self.note(folder + "vertex.obj", "colours of its vertices (sRGB, 0 to 1) are the diffuse colour of 12"),
                    self.note(folder + "face.ply", "colours of its faces (sRGB, 0 to 255) are the diffuse colour of 12"),
                    self.note(folder + "s_viscam.stl", "colours of its faces (sRGB, 0 to 31)")]
        for rows in pictures:
            colours = {tuple(row[3 * x:3 * x + 3]) for row in rows for x in range(32)}
            self.assertTrue(any(max(c) - min(c) > 60 for c in colours), "not all grey")

    def test_ply_texture_silent(self):
        for name in ("wedge_ascii.ply", "vert_st.ply"):
            rows = self.told("ply_texture_silent/" + name)
            self.assertRegex(self.report(os.path.join(FIELD, "ply_texture_silent", name))["files"][-1], "tex4.png$")
            self.assertGreater(len({tuple(row[3 * x:3 * x + 3]) for row in rows for x in range(32)}), 8, "a texture")

    def test_no_usemtl(self):
        rows = self.told("no_usemtl/m_nouse.obj", "m_nouse.obj: no usemtl, so the one material of its MTL, 'm', is used")
        self.assertGreater(len({tuple(row[3 * x:3 * x + 3]) for row in rows for x in range(32)}), 8, "a texture")


class HighlightTest(FieldCase):
    def test_specular_ns0(self):
        ns0 = self.told("specular_ns0/m_ns0.obj")
        self.assertEqual(ns0, self.plain("specular_ns0/m_ns0.obj", "m_ns0.mtl", "newmtl m\nKd .5 .1 .1\n"))
        table = self.told("specular_ns0/r_bullet_table.obj")
        self.assertEqual(table, self.plain("specular_ns0/r_bullet_table.obj", "r_bullet_table.mtl",
                                           "newmtl m\nKd .8 .8 .8\nmap_Kd tex4.png\n"))
        usual = "newmtl m\nKd .5 .1 .1\nKs 1 1 1\nNs 30\n"
        self.assertEqual(self.told("specular_ns0/m_nons.obj"), self.plain("specular_ns0/m_nons.obj", "m_nons.mtl", usual))

    def test_mtl_kd255(self):
        self.told("mtl_kd255/m_kd255.obj", "1 materials have a Kd or Ks far above 1: colours of 0 to 255? ('m')")


class SizeTest(FieldCase):
    NEAR = ("--size", "160x120", "--eye", "4,2.5,6", "--target", "0,0,0", "--light", "2,3,1", "-q")

    def differing_pixels(self, scene, one, other):
        rows = []
        for options in (one, other):
            self.succeed("render", scene, *self.NEAR, *options, "-o", "near.png")
            rows.append(b"".join(bytes(row) for row in Png.read(self.path("near.png")).rows))
        return sum(rows[0][i:i + 3] != rows[1][i:i + 3] for i in range(0, len(rows[0]), 3))

    def test_near_plane_large_scene(self):
        for name in ("ground1e5_ok.obj", "ground3e5.obj"):
            scene = os.path.join(FIELD, "near_plane_large_scene", name)
            self.assertEqual(self.differing_pixels(scene, (), ("--method", "reference")), 0, name)

    def test_lispsm_large_ground(self):
        for name in ("ground1e4.obj", "ground2e4.obj"):
            scene = os.path.join(FIELD, "lispsm_large_ground", name)
            for shadows in ("map", "blur"):
                warped, uniform = (self.differing_pixels(scene, ("--shadows", shadows, "--shadow-warp", warp),
                                                         ("--method", "reference")) for warp in ("lispsm", "uniform"))
                self.assertLessEqual(warped, uniform, (name, shadows))

    def test_stray_triangle(self):
        told = "1 triangles lie far from all others (one at 1000, 0, 0); the default camera does not frame them"
        rows = self.told("stray_triangle/g_stray.obj", told)
        middle = rows[12][3 * 16:3 * 17]
        self.assertNotEqual(middle, rows[0][:3], "the cube is in the middle of the picture")


class FormsTest(FieldCase):
    """Files of all sorts that describe one thing."""

    def test_off_headers(self):
        plain = self.told("off_headers/plain.off")
        for name in ("modelnet", "nokey", "lower", "oneline", "splitcounts"):
            self.assertEqual(self.told(f"off_headers/{name}.off"), plain, name)
        self.told("off_headers/ncoff.off")
        notes = self.report(os.path.join(FIELD, "off_headers", "ncoff.off"))["notes"]
        self.assertIn("the colours of its vertices (sRGB, 0 to 255) are the diffuse colour of 12 triangles", notes[0])

    def test_ply_tristrips(self):
        self.assertGreater(len({bytes(row) for row in self.told("ply_tristrips/tristrips_ascii.ply")}), 8, "a surface")

    def test_stl_forms(self):
        cube = self.told("stl_text_forms/comment.stl")
        self.assertEqual(self.told("stl_text_forms/noend.stl", "have no 'endsolid'; is the file cut short?"), cube)
        self.assertEqual(self.told("stl_count0/s_count0.stl", "its size is that of 12"), cube)

    def test_nan_unreferenced(self):
        with open(os.path.join(FIELD, "nan_unreferenced", "unref.obj"), encoding="utf-8") as file:
            self.write("cube.obj", "".join(line for line in file if "nan" not in line))
        cube = self.fine("cube.obj")
        for name in ("unref.obj", "p_nanunref.ply"):
            self.assertEqual(self.told("nan_unreferenced/" + name, "1 vertices are NaN"), cube, name)
        self.told("nan_unreferenced/s_nan.stl", "4 facets with a corner that is NaN")


class InsideOutTest(FieldCase):
    def far_pixels(self, a, b):
        return sum(abs(x - y) > 3 for r, s in zip(a, b) for x, y in zip(r, s))

    def test_glass_inward(self):
        right, turned = (self.told(f"glass_inward/{name}.obj", *says) for name, says in (
            ("out", ()), ("in", ("1 closed bodies were wound inward and are turned outward",))))
        self.assertEqual(self.far_pixels(right, turned), 0)

    def test_inside_out_body(self):
        flat = "32 triangles of zero area"
        two, flipped = self.told("inside_out_body/two.obj", flat), self.told("inside_out_body/two_flip.obj", flat)
        self.assertEqual(self.far_pixels(two, flipped), 0)
        town = self.told("inside_out_body/town50_ok.obj", "1 closed bodies were wound inward")
        self.assertEqual(self.far_pixels(town, self.told("inside_out_body/town75.obj", "6 closed bodies")), 0)
        self.told("inside_out_body/boar.off", "1 closed bodies were wound inward")
        report = self.report(os.path.join(FIELD, "inside_out_body", "boar.off"))
        self.assertGreater(sum(x * x for x in report["frame"]["eye"]) ** .5, max(report["extent"]), "outside")


if __name__ == "__main__":
    unittest.main()
