// BT.709: Y' = 0.2126 R + 0.7152 G + 0.0722 B, Cb = (B - Y')/1.8556, Cr = (R - Y')/1.5748, scaled
// to 16..235 and 16..240, rounded, in 16-bit fixed point. The primaries of sRGB are BT.709's, and
// its transfer curve is taken as BT.709's, as every player does.
#include "app/export/colour.h"

// Coefficients times 65536: luma of 219/255, chroma of 224/255.
enum {
  Y_R = 11966, // 0.2126 * 219/255
  Y_G = 40254, // 0.7152 * 219/255
  Y_B = 4064,  // 0.0722 * 219/255
  B_R = -6596, // -0.2126/1.8556 * 224/255
  B_G = -22189,
  B_B = 28785, // 0.9278/1.8556 * 224/255, so that grey stays grey
  R_R = 28785,
  R_G = -26145,
  R_B = -2640,
  ONE = 65536
};

static void luma_row(uint8_t *restrict y, const uint32_t *restrict row, int width) {
  for (int i = 0; i < width; i++) {
    int r = (int)(row[i] >> 16 & 255u), g = (int)(row[i] >> 8 & 255u), b = (int)(row[i] & 255u);
    y[i] = (uint8_t)((Y_R * r + Y_G * g + Y_B * b + 16 * ONE + ONE / 2) >> 16);
  }
}

static void chroma_row(uint8_t *restrict cb, uint8_t *restrict cr, const uint32_t *restrict top,
                       const uint32_t *restrict low, int pairs) {
  for (int i = 0; i < pairs; i++) {
    uint32_t a = top[2 * i], b = top[2 * i + 1], c = low[2 * i], d = low[2 * i + 1];
    // Sums of four: coefficients are used times 1/4.
    int red = (int)((a >> 16 & 255u) + (b >> 16 & 255u) + (c >> 16 & 255u) + (d >> 16 & 255u));
    int green = (int)((a >> 8 & 255u) + (b >> 8 & 255u) + (c >> 8 & 255u) + (d >> 8 & 255u));
    int blue = (int)((a & 255u) + (b & 255u) + (c & 255u) + (d & 255u));
    cb[i] = (uint8_t)((B_R * red + B_G * green + B_B * blue + 4 * 128 * ONE + 2 * ONE) >> 18);
    cr[i] = (uint8_t)((R_R * red + R_G * green + R_B * blue + 4 * 128 * ONE + 2 * ONE) >> 18);
  }
}

void sb_colour_to_yuv420(uint8_t *const plane[3], const int plane_stride[3], const uint8_t *pixels,
                         size_t stride, int width, int height) {
  int even_width = (width + 1) & ~1, even_height = (height + 1) & ~1;
  for (int j = 0; j < even_height; j += 2) {
    const uint32_t *top = (const uint32_t *)(const void *)(pixels + (size_t)j * stride);
    int below = j + 1 < height ? j + 1 : j;
    const uint32_t *low = (const uint32_t *)(const void *)(pixels + (size_t)below * stride);
    uint8_t *y0 = plane[0] + (size_t)j * (size_t)plane_stride[0];
    uint8_t *y1 = y0 + plane_stride[0];
    luma_row(y0, top, width);
    luma_row(y1, low, width);
    uint8_t *cb = plane[1] + (size_t)(j / 2) * (size_t)plane_stride[1];
    uint8_t *cr = plane[2] + (size_t)(j / 2) * (size_t)plane_stride[2];
    chroma_row(cb, cr, top, low, width / 2);
    if (even_width > width) {
      y0[width] = y0[width - 1];
      y1[width] = y1[width - 1];
      const uint32_t last_top[2] = {top[width - 1], top[width - 1]};
      const uint32_t last_low[2] = {low[width - 1], low[width - 1]};
      chroma_row(cb + width / 2, cr + width / 2, last_top, last_low, 1);
    }
  }
}
