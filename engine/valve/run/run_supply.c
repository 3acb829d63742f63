// The supply of liquid at the inlets of the strokes, and the layers on the bore.
//
// The bore enters the contact from the left on the in-stroke and from the right on the return; the
// stem of a gasket valve moves the other way round. Left of a seal is the room that it seals, right
// of it the next room, right of the outer seal the air. Liquid floods the inlet. In a room without
// liquid the bore brings what the previous stroke left on it: the layer that the contact
// transported, flow divided by speed. The layer is a volume per area, so that one number applies to
// a thin film and a rough gap.
//
// Volumes are recorded by position, whatever models.inlet is: a seal at displacement s has left a
// layer on all the bore that it has passed, from its start to s. On the return it takes from each
// position what its film can carry there, and at most the layer there; the remainder stays outside.
// So the net leakage is never negative. Not modelled: liquid that is not taken back collects in
// front of the inlet and is taken later, or dries. So the reported net leakage is the maximum.
#include "engine/valve/run/run_private.h"

#include <math.h>

// Returns whether a seal has liquid on its left or right in a state of the chamber.
static bool is_wet(const SbModel *model, int seal, SbChamber chamber, bool left) {
  if (left ? seal == SB_INNER : seal == SB_OUTER) {
    return left; // the canister; the air
  }
  return sb_valve_type(model)->is_wet(model, chamber);
}

// Returns whether the stem's motion in a direction brings the bore on the left of the seal into its
// contact.
static bool enters_left(const SbModel *model, int direction) {
  return (direction == SB_CYCLE_IN) == (sb_model_way(model) > 0);
}

// Returns whether nothing is carried: towards the air out of a room without liquid.
static bool is_dry(const SbModel *model, int seal, SbChamber chamber, int direction) {
  return enters_left(model, direction) && !is_wet(model, seal, chamber, true);
}

double sb_run_layer(SbRun *run, int seal, SbChamber chamber, int direction, double speed) {
  if (is_dry(run->model, seal, chamber, direction)) {
    return 0;
  }
  SbSealState state;
  sb_run_state_at(&state, run, seal, (int)chamber, direction, speed);
  return state.layer;
}

SbSupply sb_run_supply(const SbRun *run, int seal, SbChamber chamber, int motion) {
  const SbModel *model = run->model;
  if (!model->inlet_carried || motion == SB_RUN_REST ||
      is_wet(model, seal, chamber, enters_left(model, motion))) {
    return (SbSupply){0};
  }
  if (sb_valve_type(model)->layer_evaporates) {
    return (SbSupply){true, 0};
  }
  const bool in = motion == SB_CYCLE_IN;
  // A chamber that is closed again slides back over the layer that it passed at rest. With ports
  // that fill and vent it this is not known beforehand, and the same chamber replaces it.
  const bool ports = model->pressure_map == SB_MAP_PORTS;
  const SbChamber before = chamber == SB_CHAMBER_CLOSED && !ports ? SB_CHAMBER_AT_REST : chamber;
  const bool dry = in || is_dry(model, seal, before, SB_CYCLE_IN);
  const double layer = dry ? 0 : run->cycle.state[seal][before][SB_CYCLE_IN].layer;
  return (SbSupply){true, isfinite(layer) ? layer : 0};
}

void sb_bore_start(SbBore *bore, double s) {
  *bore = (SbBore){.start = s};
}

// Two neighbours become one of their volume.
static void halve(SbBore *bore) {
  size_t kept = 0;
  double from = bore->start;
  for (size_t i = 0; i < bore->count; i += 2) {
    const SbBoreLayer a = bore->item[i];
    const SbBoreLayer b = i + 1 < bore->count ? bore->item[i + 1] : a;
    const double length = b.end - from;
    const double volume = a.layer * (a.end - from) + b.layer * (b.end - a.end);
    bore->item[kept++] = (SbBoreLayer){b.end, length > 0 ? volume / length : 0};
    from = b.end;
  }
  bore->count = kept;
}

void sb_bore_move(SbBore *bore, double from, double to, double layer) {
  if (to > from) {
    SbBoreLayer *last = bore->count > 0 ? &bore->item[bore->count - 1] : NULL;
    bore->start = last == NULL ? from : bore->start;
    bore->out += layer * (to - from);
    if (last != NULL && last->layer == layer) {
      last->end = to;
      return;
    }
    if (bore->count == SB_BORE_LAYERS) {
      halve(bore);
    }
    bore->item[bore->count++] = (SbBoreLayer){to, layer};
    return;
  }
  // Back over the newest layers first; before the start there is none.
  while (bore->count > 0 && from > to) {
    SbBoreLayer *last = &bore->item[bore->count - 1];
    const double begin = bore->count > 1 ? last[-1].end : bore->start, end = fmax(begin, to);
    bore->back += fmin(layer, last->layer) * (from - end);
    last->end = from = end;
    bore->count -= end <= begin;
  }
}
