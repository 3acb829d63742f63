// Measured rows in charts of the force over the displacement: dots, the band between the minimum
// and the maximum force, and a strip of residuals. The axes are those of the loop: displacements
// [mm] and forces [N]. No more than some hundred rows are drawn, spread evenly and not smoothed.
#pragma once

#include "app/data/compare.h"
#include "app/draw/axis.h"

// Draws one measured point at the pixel `at`: filled, or `open` (return).
void sb_measured_loop_dot(SbCanvas *c, SbPoint at, bool open);

// Fills the band of each direction of motion with the opacity `alpha`; nothing if of->end is 0.
void sb_measured_loop_band(SbCanvas *c, const SbAxes *at, const SbMeasuredBand *of, SbRole role,
                           double alpha);

// Draws the measured forces of both directions as filled dots.
void sb_measured_loop_points(SbCanvas *c, const SbAxes *at, const SbComparison *of);

// Draws the strip of measured minus computed forces into the rectangle `strip` [px] under the loop,
// with about `wanted` ticks and, if `numbers`, the loop's ticks of x and their name below it: the
// band that contains 95 % of the noise, filled dots of the in-stroke, open ones of the return.
// `most` [N]: the largest residual that must be in the range, > 0. `of` NULL: only the axes.
void sb_measured_loop_residuals(SbCanvas *c, SbRect strip, const SbAxes *loop, bool numbers,
                                const SbComparison *of, double most, int wanted);
