// Median cut. See quantise.h.
#include "app/export/quantise.h"

#include <glib.h>
#include <stdbool.h>
#include <string.h>

enum {
  BITS = 5,
  BINS = 1 << (3 * BITS),
  ENTRIES = 256,
  COLOURS = 255, // the encoder uses the last entry for pixels that do not change
  UNKNOWN = 256,
  // Two colours closer than this look the same next to each other: sum of squares of the
  // differences of the channels.
  CLOSE = 3 * 12 * 12,
  // A palette is replaced when more than one pixel in this many is not close to its entry.
  FAR_PIXELS = 1000
};

// Colours of one bin of the picture: their number and sums, and by a majority vote (R. Boyer and
// J. Moore 1981) the colour of more than half of them, should there be one.
typedef struct {
  uint32_t count, votes, vote;
  uint64_t sum[3];
} Bin;

// A box of bins: members[first, first + count).
typedef struct {
  int first, count;
  uint64_t pixels;
  int channel; // the longest side
  int side;
} Box;

struct SbQuantiser {
  bool ready;
  size_t allowed; // pixels of a picture that may be far from their entries
  uint32_t entry[ENTRIES];
  int entries;
  uint16_t index[BINS]; // of the palette for each bin; UNKNOWN: not looked up so far
  bool far[BINS];       // the entry is not close to the bin's colours
  Bin bin[BINS];
  uint16_t member[BINS], sorted[BINS];
};

SbQuantiser *sb_quantiser_create(void) {
  return g_new0(SbQuantiser, 1);
}

void sb_quantiser_destroy(SbQuantiser *of) {
  g_free(of);
}

static unsigned channel_of(uint32_t colour, int channel) {
  return colour >> (8 * channel) & 0xFF;
}

static unsigned bin_of(uint32_t colour) {
  return (colour >> 19 & 0x1F) << 2 * BITS | (colour >> 11 & 0x1F) << BITS | (colour >> 3 & 0x1F);
}

// Coordinate of a bin: channel 0 is blue, 2 is red.
static int place_of(unsigned bin, int channel) {
  return (int)(bin >> (BITS * channel) & 0x1F);
}

static int distance(uint32_t a, uint32_t b) {
  int sum = 0;
  for (int channel = 0; channel < 3; channel++) {
    const int by = (int)channel_of(a, channel) - (int)channel_of(b, channel);
    sum += by * by;
  }
  return sum;
}

static void count_colours(SbQuantiser *of, const uint8_t *pixels, size_t stride, int width,
                          int height) {
  memset(of->bin, 0, sizeof of->bin);
  for (int y = 0; y < height; y++) {
    const uint32_t *row = (const uint32_t *)(const void *)(pixels + (size_t)y * stride);
    for (int x = 0; x < width; x++) {
      Bin *bin = &of->bin[bin_of(row[x])];
      bin->count++;
      for (int channel = 0; channel < 3; channel++) {
        bin->sum[channel] += channel_of(row[x], channel);
      }
      if (bin->votes == 0) {
        bin->vote = row[x];
      }
      bin->votes += bin->vote == row[x] ? 1 : UINT32_MAX; // minus one
    }
  }
}

// Fills what follows from the members of a box.
static void measure(const SbQuantiser *of, Box *box) {
  int low[3] = {31, 31, 31}, high[3] = {0, 0, 0};
  box->pixels = 0;
  for (int i = box->first; i < box->first + box->count; i++) {
    box->pixels += of->bin[of->member[i]].count;
    for (int channel = 0; channel < 3; channel++) {
      low[channel] = MIN(low[channel], place_of(of->member[i], channel));
      high[channel] = MAX(high[channel], place_of(of->member[i], channel));
    }
  }
  box->side = -1;
  for (int channel = 0; channel < 3; channel++) {
    if (high[channel] - low[channel] > box->side) {
      box->side = high[channel] - low[channel];
      box->channel = channel;
    }
  }
}

// Sorts the members of a box along its longest side (counting sort) and splits it where half of its
// pixels are.
static Box split(SbQuantiser *of, Box *box) {
  int start[33] = {0};
  for (int i = box->first; i < box->first + box->count; i++) {
    start[place_of(of->member[i], box->channel) + 1]++;
  }
  for (int i = 0; i < 32; i++) {
    start[i + 1] += start[i];
  }
  for (int i = box->first; i < box->first + box->count; i++) {
    of->sorted[start[place_of(of->member[i], box->channel)]++] = of->member[i];
  }
  memcpy(of->member + box->first, of->sorted, (size_t)box->count * sizeof *of->sorted);
  uint64_t below = 0;
  int at = 0;
  // Each half has at least one bin.
  while (at < box->count - 1 && (at == 0 || 2 * below < box->pixels)) {
    below += of->bin[of->member[box->first + at]].count;
    at++;
  }
  Box upper = {.first = box->first + at, .count = box->count - at};
  box->count = at;
  measure(of, box);
  measure(of, &upper);
  return upper;
}

// The colour of a box: that of most of its pixels if there is one, else the mean.
static uint32_t colour_of(const SbQuantiser *of, const Box *box) {
  uint64_t sum[3] = {0};
  const Bin *most = &of->bin[of->member[box->first]];
  for (int i = box->first; i < box->first + box->count; i++) {
    const Bin *bin = &of->bin[of->member[i]];
    most = bin->count > most->count ? bin : most;
    for (int channel = 0; channel < 3; channel++) {
      sum[channel] += bin->sum[channel];
    }
  }
  if (2 * (uint64_t)most->votes > box->pixels) {
    return most->vote | 0xFF000000u;
  }
  uint32_t mean = 0xFF000000u;
  for (int channel = 0; channel < 3; channel++) {
    mean |= (uint32_t)((sum[channel] + box->pixels / 2) / box->pixels) << (8 * channel);
  }
  return mean;
}

// The box to split next: most pixels times side; NULL where every box is one bin.
static Box *largest(Box *box, int count) {
  Box *found = NULL;
  for (int i = 0; i < count; i++) {
    const bool larger = found == NULL || box[i].pixels * (uint64_t)box[i].side >
                                             found->pixels * (uint64_t)found->side;
    found = box[i].count > 1 && larger ? &box[i] : found;
  }
  return found;
}

static void make_palette(SbQuantiser *of, const uint8_t *pixels, size_t stride, int width,
                         int height) {
  count_colours(of, pixels, stride, width, height);
  Box box[COLOURS] = {{0}};
  int count = 1;
  for (int i = 0; i < BINS; i++) {
    if (of->bin[i].count > 0) {
      of->member[box[0].count++] = (uint16_t)i;
    }
  }
  measure(of, &box[0]);
  for (Box *next; count < COLOURS && (next = largest(box, count)) != NULL; count++) {
    box[count] = split(of, next);
  }
  memset(of->entry, 0, sizeof of->entry);
  for (int i = 0; i < ENTRIES; i++) {
    of->entry[i] = i < count ? colour_of(of, &box[i]) : 0xFF000000u;
  }
  of->entries = count;
  for (int i = 0; i < BINS; i++) {
    of->index[i] = UNKNOWN;
    of->far[i] = false;
  }
  of->ready = true;
}

static void look_up(SbQuantiser *of, unsigned bin, uint32_t colour) {
  int best = 0;
  for (int i = 1; i < of->entries; i++) {
    best = distance(of->entry[i], colour) < distance(of->entry[best], colour) ? i : best;
  }
  of->index[bin] = (uint16_t)best;
  of->far[bin] = distance(of->entry[best], colour) > CLOSE;
}

// Returns the number of pixels whose entry is not close.
static size_t map(SbQuantiser *of, uint8_t *out, int out_stride, const uint8_t *pixels,
                  size_t stride, int width, int height) {
  size_t far = 0;
  for (int y = 0; y < height; y++) {
    const uint32_t *row = (const uint32_t *)(const void *)(pixels + (size_t)y * stride);
    uint8_t *to = out + (ptrdiff_t)y * out_stride;
    for (int x = 0; x < width; x++) {
      const unsigned bin = bin_of(row[x]);
      if (of->index[bin] == UNKNOWN) {
        look_up(of, bin, row[x]);
      }
      to[x] = (uint8_t)of->index[bin];
      far += of->far[bin];
    }
  }
  return far;
}

const uint32_t *sb_quantise(SbQuantiser *of, uint8_t *out, int out_stride, const uint8_t *pixels,
                            size_t stride, int width, int height) {
  if (!of->ready || map(of, out, out_stride, pixels, stride, width, height) > of->allowed) {
    make_palette(of, pixels, stride, width, height);
    const size_t far = map(of, out, out_stride, pixels, stride, width, height);
    of->allowed = 2 * far + (size_t)width * (size_t)height / FAR_PIXELS;
  }
  return of->entry;
}
