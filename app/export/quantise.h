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

// Returns a quantiser without a palette. Freed with sb_quantiser_destroy(), which takes NULL.
SbQuantiser *sb_quantiser_create(void);
void sb_quantiser_destroy(SbQuantiser *of);

// Writes a picture (cairo's ARGB32, opaque) as indices of the palette. The palette of the pictures
// before is used while it is close to the colours of this one; else the palette is made from this
// picture. Returns the 256 entries as 0xFFRRGGBB, borrowed until the next call; the last entry is
// not used by any picture.
const uint32_t *sb_quantise(SbQuantiser *of, uint8_t *out, int out_stride, const uint8_t *pixels,
                            size_t stride, int width, int height);
