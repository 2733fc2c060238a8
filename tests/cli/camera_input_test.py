"""How the real binary treats odd and bad cameras, in camera files, in scene files and as flags.

The same fault is exit code 3 in a file and 2 as a flag: a flag is usage."""

import json
import os
import unittest

from scene_case import SceneCase

MESH = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def key(frame=1, eye=(0, 0, 5), target=(0.3, 0.3, 0), **more):
    return {"frame": frame, "eye": list(eye), "target": list(target), **more}


def view(**more):
    return {name: value for name, value in key(**more).items() if name != "frame"}


class CameraCase(SceneCase):
    def setUp(self):
        super().setUp()
        self.write("mesh.obj", MESH)

    def path_file(self, *keys):
        self.write("path.json", json.dumps({"keyframes": list(keys)}))
        return ("--camera", "path.json")

    def scene_file(self, **camera):
        self.write("scene.json", json.dumps({"meshes": ["mesh.obj"], "camera": camera}))
        return "scene.json"


class FaultsTest(CameraCase):
    def test_no_file(self):
        os.mkdir(self.path("folder.json"))
        self.write("torn.json", '{"keyframes":[\n{"frame":1,')
        self.write("list.json", "[]")
        self.write("empty.json", "")
        self.write("odd.json", '{"keyframes":[],"speed":2}')
        self.write("both.json", '{"keyframes":[],"orbit":{}}')
        for name, says in (("gone.json", "gone.json cannot be opened"), ("folder.json", "is a directory"),
                           ("torn.json", "torn.json:2:"), ("empty.json", "empty.json:1:1"), ("list.json", "an object"),
                           ("odd.json", "unknown key 'speed'"), ("both.json", "either 'keyframes' or 'orbit'")):
            with self.subTest(name):
                self.refuse("mesh.obj", says, options=("--camera", name))

    def test_keys(self):
        for keys, says in (
                ([], "path.json: keyframes: there are no keys"),
                ([key(3), key(2)], "keyframes[1]: frame 2 comes after frame 3; put the keys in order"),
                ([key(3), key(4), key(4)], "keyframes[2]: frame 4 is there twice"),
                ([key(eye=(1, 2, 3), target=(1, 2, 3))], "keyframes[0]: eye and target are the same point"),
                ([key(fov_y_deg=0)], "keyframes[0].fov_y_deg: 0: must be"),
                ([key(), key(2, fov_y_deg=180)], "keyframes[1].fov_y_deg: 180: must be"),
                ([key(fov_y_deg=-1)], "fov_y_deg"), ([key(fov_y_deg="wide")], "fov_y_deg: must be a number"),
                ([key(up=[0, 0, 0])], "keyframes[0].up: must not be zero"),
                ([key(light=[0, 0, 0])], "keyframes[0].light: must not be zero"),
                ([key(eye=(1, 2))], "keyframes[0].eye: must be three numbers"),
                ([key(eye=(1e30, 0, 0))], "keyframes[0].eye[0]: must be below"),
                ([{"eye": [0, 0, 5], "target": [0, 0, 0]}], "'frame' is missing"),
                ([{"frame": 1, "eye": [0, 0, 5]}], "'target' is missing"),
                ([key(roll=1)], "unknown key 'roll'")):
            with self.subTest(says):
                self.refuse("mesh.obj", says, options=self.path_file(*keys))

    def test_numbers_that_json_has_not(self):
        for number in ("NaN", "Infinity", "1e999"):
            self.write("path.json", '{"keyframes":[{"frame":1,"eye":[0,0,%s],"target":[0,0,0]}]}' % number)
            self.refuse("mesh.obj", "path.json", options=("--camera", "path.json"))

    def test_orbits(self):
        good = {"target": [0, 0, 0], "radius": 3}
        for orbit, says in (({**good, "radius": 0}, "radius: must be more than 0"),
                            ({"radius": 3}, "'target' is missing"),
                            ({**good, "fov_y_deg": 180}, "fov_y_deg: 180"), ({**good, "height": 1e31}, "height")):
            with self.subTest(says):
                self.write("orbit.json", json.dumps({"orbit": orbit}))
                self.refuse("mesh.obj", says, options=("--camera", "orbit.json"))

    def test_in_a_scene_file(self):
        for camera, says in ((view(eye=(0, 0, 0), target=(0, 0, 0)), "scene.json: camera: eye and target are the same"),
                             (view(fov_y_deg=0), "scene.json: camera.fov_y_deg: 0"),
                             (view(fov_y_deg=180), "scene.json: camera.fov_y_deg: 180"), ({}, "'eye' is missing")):
            with self.subTest(says):
                self.refuse(self.scene_file(**camera), says)
        self.write("scene.json", json.dumps({"meshes": ["mesh.obj"], "camera_path": "gone.json"}))
        self.refuse("scene.json", "gone.json cannot be opened")

    def test_as_flags(self):
        for options, says in ((("--eye", "1,1,1", "--target", "1,1,1"), "--eye and --target are the same point"),
                              (("--fov", "0"), "--fov 0: must be"), (("--fov", "180"), "--fov 180: must be"),
                              (("--eye", "1,1,1", "--up", "0,0,0"), "--up 0,0,0")):
            with self.subTest(says):
                self.refuse("mesh.obj", says, options=options, code=2)


class RepairedTest(CameraCase):
    def test_up_along_the_view_is_one_warning(self):
        down = {"eye": (0.3, 7, 0.3), "target": (0.3, 0, 0.3)}
        self.write("mesh.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 3\n")  # lies flat: all of it is seen from above
        told = "keys look along their up direction (first: frame 2); another up is used"
        seen = [
            self.warn("mesh.obj", "path.json: keyframes: 1 " + told, options=self.path_file(key(2, **down))),
            self.warn("mesh.obj", "path.json: keyframes: 3 " + told,
                      options=self.path_file(key(2, **down), key(4, **down), key(5, **down, up=[0, -2, 0]))),
            self.warn(self.scene_file(**view(**down)), "scene.json: camera: the camera looks along its up direction"),
            self.warn("mesh.obj", "the camera looks along its up direction",
                      options=("--eye", "0.3,7,0.3", "--target", "0.3,0,0.3"))]
        for rows in seen:
            self.assertGreater(len({bytes(row) for row in rows}), 1, "nothing but background")
        self.assertEqual(seen[0], seen[1])
        self.assertEqual(seen[0], seen[3])

    def test_wide_and_narrow_views_are_fine(self):
        for fov in (0.001, 179.9):
            self.warn("mesh.obj", options=self.path_file(key(fov_y_deg=fov)))


if __name__ == "__main__":
    unittest.main()
