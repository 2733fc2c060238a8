"""A long run keeps what it has: memory, open files and threads do not grow with the frames."""

import json
import os
import unittest

from cli_test_case import CliTestCase

FRAMES = 2000


class LongRunTest(CliTestCase):
    def measured(self, *options):
        """(frames done, resident bytes, open files, threads), from time to time while the frames are rendered."""
        process = self.start("render", "scene:spheres,triangles=2000", "--size", "96x72", "--frames", str(FRAMES), "--json",
                             "-o", "x.####.png", *options)
        seen = []
        for line in process.stdout:
            event = json.loads(line)
            if event["event"] != "frame" or event["done"] % 20:
                continue
            folder = f"/proc/{process.pid}"
            with open(folder + "/statm", encoding="ascii") as file:
                resident = int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
            seen.append((event["done"], resident, len(os.listdir(folder + "/fd")), len(os.listdir(folder + "/task"))))
        self.assertEqual(process.wait(), 0, process.stderr.read())
        process.stdout.close()
        process.stderr.close()
        return seen

    def test_nothing_grows(self):
        for options in (("--method", "hybrid", "--gl", "off"), ("--gl", "egl"), ("--samples", "2", "--aov", "id")):
            with self.subTest(options=options):
                seen = self.measured(*options)
                self.assertGreater(len(seen), 50)
                self.assertEqual(seen[-1][0], FRAMES)
                early, late = seen[len(seen) // 4:len(seen) // 2], seen[-len(seen) // 4:]
                for place, what, room in ((1, "resident memory", 4 << 20), (2, "open files", 3), (3, "threads", 0)):
                    self.assertLessEqual(min(s[place] for s in late), max(s[place] for s in early) + room, what)
                for name in self.files():
                    os.remove(self.path(name))


if __name__ == "__main__":
    unittest.main()
