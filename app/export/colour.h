// Pictures to video: 32-bit sRGB rows to planar YUV 4:2:0 by BT.709, limited range.
#pragma once

#include <stddef.h>
#include <stdint.h>

// Converts a picture of width by height pixels (`pixels`: rows from the top, `stride` bytes each,
// cairo's ARGB32 in the order of the machine, opaque) into the planes Y, Cb, Cr, `plane_stride`
// bytes a row. With width and height rounded up to even numbers W and H: Y has W x H bytes, Cb and
// Cr W/2 x H/2; the last column and row are repeated where W or H is larger by one. Chroma is the
// mean of each block of 2 x 2 pixels (sited at its centre).
void sb_colour_to_yuv420(uint8_t *const plane[3], const int plane_stride[3], const uint8_t *pixels,
                         size_t stride, int width, int height);
