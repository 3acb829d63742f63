// Pictures to video: 32-bit sRGB rows to planar YUV 4:2:0 by BT.709, limited range.
#pragma once

#include <stddef.h>
#include <stdint.h>

// Converts a picture of width x height (cairo's ARGB32 order, opaque) into planes of
// even_width x even_height, repeating the last column and row where those are larger by one.
// Chroma is the mean of each 2 x 2 block (sited at its centre).
void sb_colour_to_yuv420(uint8_t *const plane[3], const int plane_stride[3], const uint8_t *pixels,
                         size_t stride, int width, int height);
