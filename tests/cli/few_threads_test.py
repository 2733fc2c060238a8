"""If the system cannot start more threads, the program says so and ends, or does without."""

import os
import pty
import resource
import subprocess
import unittest

from cli_test_case import BINARY, SCENE, SMALL, CliTestCase

MIB = 1 << 20


def bounded(space_mib, stack_mib):
    """For preexec_fn: limits the address space, which threads' stacks take a share of."""
    def limit():
        resource.setrlimit(resource.RLIMIT_STACK, (stack_mib * MIB, stack_mib * MIB))
        resource.setrlimit(resource.RLIMIT_AS, (space_mib * MIB, space_mib * MIB))
    return limit


class FewThreadsTest(CliTestCase):
    def test_too_many_threads_are_refused(self):
        for command in (("inspect", SCENE), ("render", SCENE, *SMALL, "-q", "--method", "raytrace")):
            self.fail_with(2, *command, "--threads", "64", says=("threads", "--threads"),
                           preexec_fn=bounded(space_mib=3072, stack_mib=128))

    def code_on_a_terminal(self, limit, *arguments):
        ours, its = pty.openpty()
        done = subprocess.run([BINARY, *arguments], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=its,
                              timeout=60, preexec_fn=limit)
        os.close(its)
        os.close(ours)
        return done.returncode

    def test_whichever_thread_is_the_first_to_be_refused(self):
        codes = set()
        for space_mib in range(256, 3072, 128):
            limit = bounded(space_mib, stack_mib=256)
            if self.code_on_a_terminal(limit, "--help") != 0:
                continue  # libraries start threads of their own before main()
            for command in (("inspect", SCENE, "--threads", "1"),  # the loading line's thread is all it starts
                            ("render", SCENE, *SMALL, "--threads", "2", "--method", "raytrace", "--accel", "kdtree")):
                code = self.code_on_a_terminal(limit, *command)
                self.assertIn(code, (0, 2), (space_mib, command))
                codes.add((command[0], code))
        self.assertLessEqual({("inspect", 0), ("render", 2)}, codes)


if __name__ == "__main__":
    unittest.main()
