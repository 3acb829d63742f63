// Shared by the files of the section: the state of one picture, and helpers for labels. All
// functions are called by sb_section_draw() and below it, after it has set the fields of the
// picture and the rings' shapes. Those that draw append to section->list.
#pragma once

#include "app/section/palette.h"
#include "app/section/section.h"
#include "app/section/text.h"

// Largest number of reserved rectangles.
enum { SB_SECTION_PLACED_MAX = 64 };

// Hatch of the parts [px].
#define SB_HATCH_PITCH 11.0
#define SB_HATCH_WIDTH 0.7

typedef struct SbCutaway SbCutaway;

struct SbSection {
  SbModel *model; // owned
  SbSectionLimits limits;
  SbValveOutline valve;
  SbText *text;
  SbRingShape ring[SB_SEAL_COUNT];
  size_t scratch_size;   // capacity of the two arrays below
  SbPoint *scratch;      // corners of a mesh
  float *scratch_scalar; // their scalars
  SbCutaway *cutaway;    // NULL before the first
  // The picture that is being drawn; borrowed.
  SbDrawList *list;
  const SbSectionView *view;
  const SbSectionInstant *instant;
  const SbPalette *palette;
  SbRect strip;         // of the valve [px]
  double scale, x0, y0; // [px/m], and the pixel of the housing frame's origin (land edge, axis)
  size_t placed_count;
  SbRect placed[SB_SECTION_PLACED_MAX]; // reserved: later labels must not cover them [px]
};

// Returns the pixel of the point (x, y) [m] in the housing's frame.
SbPoint sb_section_at(const SbSection *section, double x, double y);

// Returns the stem's displacement at the instant [m].
double sb_section_displacement(const SbSection *section);

// Returns x of the origin of a seal's frame in the housing's frame [m].
double sb_section_origin(const SbSection *section, int seal);

// Style of a label.
typedef struct {
  double size; // [px]
  int weight;  // 400 normal, 700 bold
  SbAlign align;
  SbColor color;
  const SbColor *plate; // colour of a plate behind it; NULL: none
} SbSectionLabel;

// Draws a label with its plate, its anchor on the baseline at (x, y) [px], and reserves its
// rectangle. Returns its width [px].
double sb_section_label(SbSection *section, double x, double y, const SbSectionLabel *style,
                        const char *string);

// Returns whether a label at (x, y) would neither cover a reserved rectangle nor leave `within`
// (NULL: it may be anywhere).
bool sb_section_label_fits(SbSection *section, double x, double y, const SbSectionLabel *style,
                           const char *string, const SbRect *within);

// Reserves a rectangle [px].
void sb_section_reserve(SbSection *section, double x, double y, double width, double height);

// Length of force arrows [px/N].
#define SB_SECTION_PX_PER_NEWTON 3.4

// Radius that is drawn above the axis, divided by SbValveOutline.size.
#define SB_SECTION_TOP 0.79

// Draws the labels of the strip.
void sb_section_draw_strip_labels(SbSection *section);

// Draws the lines from the contact in the strip to the insets in these rectangles [px].
void sb_section_draw_leader(SbSection *section, const SbRect *pressure, const SbRect *film);

// Draws the insets into these rectangles [px].
void sb_section_draw_insets(SbSection *section, const SbRect *pressure, const SbRect *film);

// Draws the title, the legends of the colours, each `width` wide, and the bars of the forces with
// their top left corner at (x, y) [px].
void sb_section_draw_legends(SbSection *section, double x, double y, double width);

// Position of the housing's frame in a picture.
typedef struct {
  double x0, y0;                   // pixel of its origin
  double scale;                    // [px/m]
  double left, top, right, bottom; // visible range [px]
} SbSectionFrameMap;

// Returns the position for a picture that shows `rect` [px].
SbSectionFrameMap sb_section_frame_map(double x0, double y0, double scale, const SbRect *rect);

// Draws the housing.
void sb_section_draw_housing(SbSection *section, const SbSectionFrameMap *map);

// Draws the stem.
void sb_section_draw_stem(SbSection *section, const SbSectionFrameMap *map);

// Returns the pixel y of the valve's axis, or of the strip's lower end if the axis is below it.
double sb_section_axis(const SbSection *section);

// Returns the style of a label of 12 px. `plate` (NULL: none) is borrowed.
SbSectionLabel sb_section_label_style(SbColor color, int weight, SbAlign align,
                                      const SbColor *plate);

// Draws the friction forces of both seals on the stem, or on the body of a gasket, with their
// values (section_forces.c).
void sb_section_draw_friction(SbSection *section);

// Draws the forces of pressure and spring at the stem's nose, and those of drive and stop at its
// rod (section_forces.c).
void sb_section_draw_stem_forces(SbSection *section);

// Draws a label at the first of the positions at[count] (x, y) [px] in the strip where it fits.
// Returns false if it fits at none.
bool sb_section_place(SbSection *section, const double (*at)[2], size_t count,
                      const SbSectionLabel *style, const char *string);

// Largest number of knots of a curve, and of its points.
enum { SB_SECTION_KNOTS = 7, SB_SECTION_WAY = 73 };

// Writes the points of a Catmull-Rom curve through knot[knots], 2 to SB_SECTION_KNOTS, to
// out[SB_SECTION_WAY] and returns their number.
size_t sb_section_curve(SbValvePoint *out, const SbValvePoint *knot, int knots);

// Draws the path of the liquid along way[count], 4 to SB_SECTION_WAY points of the housing's frame
// [m], as an arrow in the strip.
void sb_section_draw_way(SbSection *section, const SbValvePoint *way, size_t count);

// Draws the bold name of a space with its pressure [Pa] after it, or `below` it, at (x, y) [px],
// unless it would cover another label or leave the strip.
void sb_section_name_pressure(SbSection *section, double x, double y, const char *name,
                              double pressure, bool below);

// Draws the labels of a gasket valve (section_gasket.c): all of them if `whole`, else only the
// names of the gaskets.
void sb_section_gasket_labels(SbSection *section, bool whole);

// Writes the ends of a field's colour map [SI of the field].
void sb_section_field_limits(const SbSection *section, SbField field, double *least,
                             double *greatest);

// A plane in the picture: the point (x, y) [m] is at pixel (x0 + xx x + xy y, y0 + yx x + yy y).
typedef struct {
  double x0, xx, xy, y0, yx, yy;
} SbSectionPlane;

// Returns the pixel of a point of a plane.
SbPoint sb_section_plane_at(const SbSectionPlane *plane, double x, double y);

// Draws the ring of a seal. `plane` is the plane of the seal's frame: x along the axis, y above the
// groove floor.
void sb_section_draw_ring(SbSection *section, int seal, const SbSectionPlane *plane);

// Size of the buffers of the functions below [bytes].
enum { SB_SECTION_NUMBER = 64 };

// The functions below write a number to `buffer` with a minus sign, thin spaces between thousands,
// and "0" for zero. They return `buffer`.

// Writes a force [N] in N, with one decimal below 100.
const char *sb_section_force(char *buffer, double newtons);

// Writes a pressure [Pa] in MPa, with two decimals below 10, one below 100.
const char *sb_section_megapascal(char *buffer, double pascals);

// Writes a length [m] in mm, with two decimals below 10, one below 100.
const char *sb_section_millimetre(char *buffer, double metres);

// Writes a number without a unit with `decimals` decimals.
const char *sb_section_fixed(char *buffer, double value, int decimals);

// Writes a number without a unit with two significant digits.
const char *sb_section_two_digits(char *buffer, double value);

// Writes a number without a unit with the fewest decimals that change it by at most 0.5 %, at most
// six.
const char *sb_section_significant(char *buffer, double value);
