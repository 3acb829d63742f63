#!/usr/bin/python3
"""What the squeeze of the outer seal does: its load, peak pressure and friction, swept by evaluate().

    sweep_squeeze.py [SCENE] [-o FILE.svg|FILE.csv]

The bore moves and the groove floor stays, so that the stretch on the floor is the scene's throughout.
The picture needs matplotlib; without it, or with .csv, the table is written.
"""
import argparse
import csv
import sys

import sealbench

FIGURES = ["seals.outer.squeeze", "seals.outer.load_N", "seals.outer.pressure_peak_Pa",
           "seals.outer.friction_boundary_N", "seals.outer.friction_viscous_N"]

arguments = argparse.ArgumentParser(description=__doc__)
arguments.add_argument("scene", nargs="?", help="a valve or scene file; without it the thesis' valve")
arguments.add_argument("-o", "--output", default="sweep.csv")
arguments.add_argument("--points", type=int, default=21)
given = arguments.parse_args()

scene = sealbench.Scene(given.scene)
diameter, space, bore = (scene[key] for key in
                         ("seal.section_diameter", "gland.radial_space", "bore.diameter"))
rows = []
for i in range(given.points):
    # From 8 % to as much as leaves the stem in its bore.
    squeeze = 0.08 + (0.20 - 0.08) * i / (given.points - 1)
    gap = diameter * (1 - squeeze)
    overrides = {"gland.radial_space": gap, "bore.diameter": bore + 2 * (gap - space)}
    try:
        rows.append(list(scene.evaluate(FIGURES, overrides).values()))
    except sealbench.Error as error:
        print(f"{squeeze:.1%}: {error}", file=sys.stderr)  # a gap in the table

try:
    from matplotlib import pyplot
except ImportError:
    pyplot = None
if given.output.endswith(".csv") or pyplot is None:
    with open(given.output, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(f"{path} [{sealbench.FIGURES[path].unit}]" for path in FIGURES)
        writer.writerows(rows)
else:
    figure, axes = pyplot.subplots(1, 2, figsize=(10, 4))
    share = [100 * row[0] for row in rows]
    axes[0].plot(share, [row[1] for row in rows])
    axes[0].set(xlabel="squeeze / %", ylabel="load of the outer seal / N")
    axes[1].plot(share, [row[3] + row[4] for row in rows])
    axes[1].set(xlabel="squeeze / %", ylabel="friction of the outer seal / N")
    figure.savefig(given.output)
