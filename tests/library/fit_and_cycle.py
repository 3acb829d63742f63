"""Fits a ring and runs the thesis' cycle by the installed module: fit_and_cycle.py SCENE."""
import sys
import sealbench
scene = sealbench.Scene(sys.argv[1])
scene["models.fit"] = "ring"
load = scene.evaluate(["seals.outer.load_N"])["seals.outer.load_N"]
del scene["models.fit"]
scene.run()
force, peak = scene.figure("cycle.stages.B.force_N"), max(scene.profile(scene.frame_count // 4).pressure)
print(f"ring {load:.17g} N, B {force:.17g} N, peak {peak:.17g} Pa")
