// See device.h.
#include "app/base/device.h"

#include "engine/valve/model/motion_kind.h"

#include <glib/gi18n.h>

// What the valve with rings and the plate, which has the same rings, share.
#define RINGS                                                                                      \
  .across = SB_P_SEAL_SECTION_DIAMETER, .up = SB_P_GLAND_RADIAL_SPACE,                             \
  .seal = {N_("Outer seal"), N_("Inner seal")}, .short_name = {N_("outer"), N_("inner")},          \
  .friction = {N_("outer friction"), N_("inner friction")},                                        \
  .off = {N_("outer seal off the land"), N_("inner seal off the land")},                           \
  .moves = {N_("bore moves right"), N_("bore moves left")}

// What all valves share.
#define OVER_DISPLACEMENT                                                                          \
  .loop = N_("Force and displacement"), .axes = N_("N over mm"), .force = N_("force on the stem")

static const SbDevice valves[] = {
    [SB_VALVE_PISTON] =
        {
            .stem = true,
            .gland = true,
            .pressure_map = true,
            RINGS,
            OVER_DISPLACEMENT,
        },
    [SB_VALVE_GASKET] =
        {
            .stem = true,
            .across = SB_P_GASKET_BORE_DIAMETER,
            .up = SB_P_GASKET_CRIMP,
            .seal = {N_("Stem gasket"), N_("Chamber gasket")},
            .short_name = {N_("stem gasket"), N_("chamber gasket")},
            .friction = {N_("stem gasket"), N_("chamber gasket")},
            .off = {N_("no friction around the neck"), N_("no friction around the neck")},
            .moves = {N_("stem moves left"), N_("stem moves right")},
            .phase = {N_("at rest, force builds up"), N_("chamber fills past the neck"),
                      N_("chamber shut, then empties"), N_("dose, at the stop"),
                      N_("return, chamber empty"), N_("return, chamber fills")},
            OVER_DISPLACEMENT,
        },
};

static const SbDevice plate = {
    .pressure_map = true,
    RINGS,
    .phase = {N_("force builds up"), N_("sticks and slips"), N_("sticks and slips"),
              N_("sticks and slips"), N_("sticks and slips"), N_("sticks and slips")},
    .loop = N_("Force and time"),
    .axes = N_("N over s"),
    .force = N_("force in the thread"),
    .picture = N_("Sliding plate on its rings"),
};

const SbDevice *sb_device_of_kind(int kind) {
  return &valves[kind];
}

const SbDevice *sb_device(const SbModel *model) {
  return model == NULL ? &valves[SB_VALVE_PISTON]
         : sb_motion_kind(model)->valve
             ? sb_device_of_kind((int)sb_model_number(model, SB_P_VALVE_KIND))
             : &plate;
}
