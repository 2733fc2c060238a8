#!/usr/bin/env python3
"""Races hybridrt against POV-Ray, Blender's Cycles and F3D: same scenes, cameras, lights, size and threads.

  scripts/peers.py --install                            all of it: half an hour on two cores
  scripts/peers.py --estimate-slow 100                  a quarter of an hour
  scripts/peers.py --only hybrid,cycles --scenes chess --frames 1,2 --rounds 1    a look

Whole jobs are timed, from the start of a process to its end, when the last picture is written. What is converted for a rival
beforehand (a .blend for Cycles, mesh2 for POV-Ray) is not timed. docs/results/peers.md has the results and says what each
picture has and lacks.
"""
import sys

from peers.command import main

sys.exit(main(sys.argv[1:], __doc__))
