// What the files of the section share: the state of one drawing and the helpers for labels.
#pragma once

#include "app/section/palette.h"
#include "app/section/section.h"
#include "app/section/text.h"

enum { SB_SECTION_PLACED_MAX = 64 };

// Of the parts [px].
#define SB_HATCH_PITCH 11.0
#define SB_HATCH_WIDTH 0.7

typedef struct SbCutaway SbCutaway;

struct SbSection {
  SbModel *model; // owned
  SbSectionLimits limits;
  SbValveOutline valve;
  SbText *text;
  SbRingShape ring[SB_SEAL_COUNT];
  size_t scratch_size; // of a mesh's corners
  SbPoint *scratch;
  float *scratch_scalar;
  SbCutaway *cutaway; // NULL before the first
  // The drawing in hand.
  SbDrawList *list;
  const SbSectionView *view;
  const SbSectionInstant *instant;
  const SbPalette *palette;
  SbRect strip;
  double scale, x0, y0; // px per m, px of the housing frame's origin (land edge, axis)
  size_t placed_count;
  SbRect placed[SB_SECTION_PLACED_MAX]; // labels that later ones must not cover
};

// Pixel of a point of the housing's frame.
SbPoint sb_section_at(const SbSection *section, double x, double y);

// Stem displacement of the instant [m].
double sb_section_displacement(const SbSection *section);

// x of seal i's origin in the housing's frame [m].
double sb_section_origin(const SbSection *section, int seal);

typedef struct {
  double size;
  int weight;
  SbAlign align;
  SbColor color;
  const SbColor *plate; // ground of the body below, or NULL
} SbSectionLabel;

// Draws a label with its plate at the baseline and reserves its place. Returns its width.
double sb_section_label(SbSection *section, double x, double y, const SbSectionLabel *style,
                        const char *string);

// Whether a label at this place would cover one that is there or leave the rectangle `within`.
bool sb_section_label_fits(SbSection *section, double x, double y, const SbSectionLabel *style,
                           const char *string, const SbRect *within);

// Reserves a rectangle.
void sb_section_reserve(SbSection *section, double x, double y, double width, double height);

// Newtons of an arrow [px/N].
#define SB_SECTION_PX_PER_NEWTON 3.4

// Radius drawn above the axis [m per m of the valve's size].
#define SB_SECTION_TOP 0.79

// Parts of the picture.
void sb_section_draw_strip(SbSection *section);
void sb_section_draw_strip_labels(SbSection *section);
void sb_section_draw_leader(SbSection *section, const SbRect *pressure, const SbRect *film);
void sb_section_draw_insets(SbSection *section, const SbRect *pressure, const SbRect *film);
void sb_section_draw_legends(SbSection *section, double x, double y, double width);

// Where the housing's frame lies in a picture: pixel of its origin, pixels per metre, and the
// pixels beyond which nothing shows.
typedef struct {
  double x0, y0, scale, left, top, right, bottom;
} SbSectionFrameMap;

// The map for a picture that shows `rect`.
SbSectionFrameMap sb_section_frame_map(double x0, double y0, double scale, const SbRect *rect);

void sb_section_draw_housing(SbSection *section, const SbSectionFrameMap *map);
void sb_section_draw_stem(SbSection *section, const SbSectionFrameMap *map);

// First of the candidate places (pairs x, y) in the strip where a label fits; false: none did.
bool sb_section_place(SbSection *section, const double (*at)[2], size_t count,
                      const SbSectionLabel *style, const char *string);

// A Catmull-Rom curve through at most SB_SECTION_KNOTS knots, its points into `out` of
// SB_SECTION_WAY, whose count is returned; and the liquid's way along such points, an arrow in the
// strip.
enum { SB_SECTION_KNOTS = 7, SB_SECTION_WAY = 73 };
size_t sb_section_curve(SbValvePoint *out, const SbValvePoint *knot, int knots);
void sb_section_draw_way(SbSection *section, const SbValvePoint *way, size_t count);

// A bold name with its pressure behind or below; gives way.
void sb_section_name_pressure(SbSection *section, double x, double y, const char *name,
                              double pressure, bool below);

// Names, regions and the liquid's way of a gasket valve (section_gasket.c).
void sb_section_gasket_labels(SbSection *section, bool whole);

// Limits of a field's colour map, in its SI unit.
void sb_section_field_limits(const SbSection *section, SbField field, double *least,
                             double *greatest);

// A plane of the picture: point (x, y) [m] lies at pixel x0 + xx x + xy y, y0 + yx x + yy y.
typedef struct {
  double x0, xx, xy, y0, yx, yy;
} SbSectionPlane;

SbPoint sb_section_plane_at(const SbSectionPlane *plane, double x, double y);

// Seal i's ring, its own frame in `plane`.
void sb_section_draw_ring(SbSection *section, int seal, const SbSectionPlane *plane);

// Numbers as the look wants them: three digits (two below ten for forces), true minus, thin-space
// thousands, "0" for zero; with the unit. The buffer holds at least SB_SECTION_NUMBER bytes.
enum { SB_SECTION_NUMBER = 64 };
const char *sb_section_force(char *buffer, double newtons);
const char *sb_section_megapascal(char *buffer, double pascals);
const char *sb_section_millimetre(char *buffer, double metres);
const char *sb_section_film(char *buffer, double metres);
const char *sb_section_fixed(char *buffer, double value, int decimals);
const char *sb_section_two_digits(char *buffer, double value);
const char *sb_section_significant(char *buffer, double value); // as short as three digits allow
