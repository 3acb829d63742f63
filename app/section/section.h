// The axial section of the valve at one instant, as a display list: what engine numbers look like.
//
// Canister on the left, axis at the bottom, housing at rest. The valve strip is to scale in both
// directions; the two insets zoom onto one seal's contact (pressure over the bore; film on a scale
// of nanometres with the exaggeration written on it). Without a ring mesh the rings are the
// schematic shapes of ring_shape.h and say so. In place of the strip it shows the valve in three
// dimensions (cutaway.h).
#pragma once

#include "app/section/draw_list.h"
#include "app/section/ring_shape.h"
#include "app/section/valve.h"
#include "engine/valve/sealbench.h"

typedef struct SbSection SbSection;

// What stays the same over a whole film.
typedef struct {
  double inner_contact_left; // of the inner seal when it reaches the land edge [m]
  double pressure_max;       // largest contact pressure, for the inset's scale [Pa]
  double film_max;           // largest central film, for the inset's scale [m]
  double force_max;          // largest of drive and canister, for the bars' scale [N]
  double contact_left[SB_SEAL_COUNT], contact_right[SB_SEAL_COUNT]; // outermost, for the inset [m]
  double field_min[SB_FIELD_COUNT], field_max[SB_FIELD_COUNT]; // of the solved rings, for the map
} SbSectionLimits;

typedef enum {
  SB_SECTION_WHOLE,      // the valve strip with insets
  SB_SECTION_ZOOM_INNER, // the strip shows one seal's surroundings
  SB_SECTION_ZOOM_OUTER
} SbSectionZoom;

typedef struct {
  double width, height; // logical pixels
  double margin;        // kept free all round
  bool dark;
  bool read_outs; // stage, time, stroke and force in place of a title, where no page has them
  bool hide_insets, hide_forces, hide_labels;
  bool bare;      // the valve or a seal fills the picture: no title, legends, scale or insets
  int inset_seal; // SB_OUTER or SB_INNER
  SbSectionZoom zoom;
  bool full;    // both halves; not when zoomed
  bool cutaway; // in three dimensions with a quarter cut away; neither zoomed nor with insets
  double azimuth, elevation; // of its camera, see sb_orbit() [rad]
  double magnify;            // of the cutaway, 0 counts as 1
  SbField field;             // shown on solved rings
  double field_max;          // end of its colours [Pa], 0: the limits'; not for displacement
  bool undeformed;           // the rings' outline before fitting, dashed
  bool mesh;                 // the elements' edges of solved rings
} SbSectionView;

// The instant to draw; everything borrowed. profile and ring may hold NULL; without a solved shape
// a ring is drawn schematically.
typedef struct {
  const SbFrame *frame;
  const SbContactProfile *profile[SB_SEAL_COUNT];
  const SbSealShape *ring[SB_SEAL_COUNT];
} SbSectionInstant;

// Prepares the drawing of one model's frames (the model is copied). Owned by the caller; for one
// thread at a time.
SbSection *sb_section_create(const SbModel *model, const SbSectionLimits *limits);
void sb_section_destroy(SbSection *section);

// Reads the limits off frames.
void sb_section_limits_of_frames(SbSectionLimits *limits, const SbFrame *frames, size_t count);

// Widens the field limits by one solved ring (NULL: nothing). The highest fiftieth of the nodes is
// left out, so that a contact's corner does not bleach the rest.
void sb_section_limits_add_shape(SbSectionLimits *limits, const SbSealShape *shape);

// The same for every solved ring of a run.
void sb_section_limits_add_run(SbSectionLimits *limits, const SbRun *run);

// "von Mises stress" and "MPa" of a field, and what its SI values are multiplied by to be in that
// unit.
const char *sb_section_field_name(SbField field);
const char *sb_section_field_unit(SbField field);
double sb_section_field_scale(SbField field);

// Fills `list` (cleared first) with the picture.
void sb_section_draw(SbSection *section, SbDrawList *list, const SbSectionView *view,
                     const SbSectionInstant *instant);

// Height that the strip of the valve would have in such a picture [px].
double sb_section_strip_height(SbSection *section, const SbSectionView *view,
                               const SbSectionInstant *instant);

// What sb_section_draw() made of seal i: the ring's outline in the housing's frame, for checks and
// hit tests. Valid after a draw; borrowed.
const SbRingShape *sb_section_ring(const SbSection *section, int seal);
const SbValveOutline *sb_section_valve(const SbSection *section);

// Logical pixels per metre and the place of the housing frame's origin (land edge on the axis) of
// the last picture.
void sb_section_transform(const SbSection *section, double *scale, double *x0, double *y0);
