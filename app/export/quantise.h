// Pictures with at most 255 colours, for GIF.
//
// Median cut over colours of 5 bits a channel (P. Heckbert, Color image quantization for frame
// buffer display, Computer Graphics 16 (1982) 297). A colour that fills most of its box is kept
// exactly, so that grounds and lines of a drawing do not change. No dithering: it would make the
// files large and still areas flicker.
#pragma once

#include <stddef.h>
#include <stdint.h>

typedef struct SbQuantiser SbQuantiser;

// Returns a quantiser without a palette. Freed by sb_quantiser_destroy().
SbQuantiser *sb_quantiser_create(void);

// Frees a quantiser.
void sb_quantiser_destroy(SbQuantiser *of);

// Converts a picture of width by height pixels (`pixels`: rows of `stride` bytes, cairo's ARGB32,
// opaque) into indices of the palette in `out`, one byte a pixel, rows of `out_stride` bytes (may
// be negative). The palette of the earlier pictures is used as long as it is close to the colours
// of this one; otherwise a new palette is made from this picture. Returns the 256 entries of the
// palette as 0xFFRRGGBB, borrowed until the next call; entry 255 is not used by any picture.
const uint32_t *sb_quantise(SbQuantiser *of, uint8_t *out, int out_stride, const uint8_t *pixels,
                            size_t stride, int width, int height);
