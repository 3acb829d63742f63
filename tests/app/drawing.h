// Drawings in tests: writes a DXF, with the stem centre of piston-profiles.valve, and checks what
// is read from it.
#pragma once

#include "app/cad/cad_private.h"

// Where the origin and the axis of a drawing are, and the angle of the axis [rad].
typedef struct {
  double x, y, angle;
} DrawingPlace;

// Returns the volume of the stem centre of piston-profiles.valve, from the engine [m3].
double drawing_stem_volume(void);

// Appends a group code and its value.
void drawing_put(GString *dxf, int code, const char *format, ...) G_GNUC_PRINTF(3, 4);

// Begins a DXF with `unit` ($INSUNITS), up to its first entity. Owned by the caller.
GString *drawing_begin(int unit);

// Ends the entities and the file.
void drawing_end(GString *dxf);

// Moves a point of the drawing to its place.
void drawing_move(const DrawingPlace *place, double *x, double *y);

// Appends a LINE.
void drawing_line(GString *dxf, const char *layer, double x0, double y0, double x1, double y1);

// Appends an ARC from one end to the other; CAD knows counter-clockwise ones only.
void drawing_arc(GString *dxf, const char *layer, double x0, double y0, double x1, double y1,
                 double bulge);

// Appends the stem's outline as lines and arcs, in no order; side -1: below the axis.
void drawing_stem(GString *dxf, const DrawingPlace *place, double scale, int side);

// Reads a DXF, which must be accepted.
SbCad *drawing_parse(const GString *dxf, const SbCadChoices *choices);

// The stem centre is the only body, with its volume, lands, bores and grooves, and one warning.
void drawing_check_stem_alone(const SbCad *cad, const char *warning);
