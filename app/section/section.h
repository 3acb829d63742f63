// The axial section of the valve at one instant, as a display list.
//
// The canister is on the left, the axis at the bottom, the housing at rest. The strip with the
// valve is to scale in both directions. Two insets enlarge the contact of one seal: pressure on the
// bore, and film on a scale of nanometres with the exaggeration written on it. Without a ring mesh
// the rings have the schematic shapes of ring_shape.h, which a label states. In place of the strip
// the valve can be shown in three dimensions (cutaway.h).
#pragma once

#include "app/section/draw_list.h"
#include "app/section/ring_shape.h"
#include "app/section/valve.h"
#include "engine/valve/sealbench.h"

typedef struct SbSection SbSection;

// Scales that are the same for all frames of a run.
typedef struct {
  double inner_contact_left; // left end of the inner contact when it reaches the land edge [m]
  double pressure_max;       // largest SbSealFrame.pressure_peak, for the inset's scale [Pa]
  double film_max;           // largest central film, for the inset's scale [m]
  double force_max;          // largest force of drive and canister, for the scale of the bars [N]
  // Smallest left and largest right end of each contact, in the seal's frame, for the inset [m].
  double contact_left[SB_SEAL_COUNT], contact_right[SB_SEAL_COUNT];
  // [SbField]: ends of the colour maps for solved rings [SI of the field]; zeros before the first
  // sb_section_limits_add_shape().
  double field_min[SB_FIELD_COUNT], field_max[SB_FIELD_COUNT];
} SbSectionLimits;

// What the strip shows.
typedef enum {
  SB_SECTION_WHOLE,      // the full valve, with insets
  SB_SECTION_ZOOM_INNER, // the surroundings of the inner seal
  SB_SECTION_ZOOM_OUTER  // the surroundings of the outer seal
} SbSectionZoom;

// How the picture is drawn. All zeros but the size is the default view.
typedef struct {
  double width, height;                       // of the picture [px]
  double margin;                              // free space at all sides [px]
  bool dark;                                  // dark colours
  bool read_outs;                             // stage, time, stroke and force in place of a title
  bool hide_insets, hide_forces, hide_labels; // omit these parts
  bool bare;      // the valve or a seal fills the picture: no title, legends, scale or insets
  int inset_seal; // SB_OUTER or SB_INNER: seal of the insets
  SbSectionZoom zoom;
  bool full;    // draw both halves; not when zoomed
  bool cutaway; // three dimensions with a quarter cut away; neither zoomed nor with insets
  double azimuth, elevation; // of the cutaway's camera, see sb_orbit() [rad]
  double magnify;            // of the cutaway; 0 counts as 1
  SbField field;             // shown by the colours of solved rings
  double field_max; // end of the colours [Pa]; 0: that of the limits; not for displacement and
                    // permeation
  bool undeformed;  // draw the rings' outlines before fitting, dashed
  bool mesh;        // draw the edges of the elements of solved rings
} SbSectionView;

// The instant to draw; everything is borrowed for the call. `summary` has the errors of the run's
// figures (NULL: it has not ended). `profile` (NULL: none) is for the insets; a ring without a
// solved shape (`ring` NULL) is drawn schematically.
typedef struct {
  const SbFrame *frame;
  const SbSummary *summary;
  const SbContactProfile *profile[SB_SEAL_COUNT];
  const SbSealShape *ring[SB_SEAL_COUNT];
} SbSectionInstant;

// Returns a section for the frames of `model` (copied, as `limits`). Freed by sb_section_destroy().
SbSection *sb_section_create(const SbModel *model, const SbSectionLimits *limits);

// Frees a section.
void sb_section_destroy(SbSection *section);

// Sets the limits from frames[count], those of fields to zeros: call it before the next two
// functions.
void sb_section_limits_of_frames(SbSectionLimits *limits, const SbFrame *frames, size_t count);

// Extends the limits of fields by one solved ring (NULL: none). The highest 2 % of the nodes are
// ignored, so that the corner of a contact does not compress the colours of the rest.
void sb_section_limits_add_shape(SbSectionLimits *limits, const SbSealShape *shape);

// Extends the limits of fields by every solved ring of a run.
void sb_section_limits_add_run(SbSectionLimits *limits, const SbRun *run);

// Returns the name of a field, "von Mises stress", untranslated.
const char *sb_section_field_name(SbField field);

// Returns the display unit of a field, "MPa".
const char *sb_section_field_unit(SbField field);

// Returns the factor that converts SI values of a field to its display unit.
double sb_section_field_scale(SbField field);

// Clears `list` and fills it with the picture. The colour maps that the list refers to are static.
void sb_section_draw(SbSection *section, SbDrawList *list, const SbSectionView *view,
                     const SbSectionInstant *instant);

// Returns the height that the strip has in the picture that sb_section_draw() draws with the same
// arguments [px].
double sb_section_strip_height(SbSection *section, const SbSectionView *view,
                               const SbSectionInstant *instant);

// Returns the outline of a ring in the last picture, in the frame of ring_shape.h, for tests and
// for finding what is under the pointer. Borrowed until the next sb_section_draw().
const SbRingShape *sb_section_ring(const SbSection *section, int seal);

// Returns the outlines of the valve. Borrowed from the section.
const SbValveOutline *sb_section_valve(const SbSection *section);

// Writes the scale of the last picture of sb_section_draw() [px/m] and the pixel (*x0, *y0) of the
// origin of the housing's frame (the land edge, on the axis). Not for a cutaway.
void sb_section_transform(const SbSection *section, double *scale, double *x0, double *y0);
