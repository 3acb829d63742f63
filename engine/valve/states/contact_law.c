// The rows of contact_law.h. Their functions are in sliding_separate.c, sliding_coupled.c and
// sliding_gasket.c.
#include "engine/valve/states/contact_law.h"

#include "engine/valve/states/sliding_private.h"

static const char edge_film[] = "blok";
static const char edge_reason[] =
    "a gasket's edge lets little in: from the rise of its pressure there";

static const SbContactLaw separate = {.solve = sb_separate_solve,
                                      .respeed = sb_ring_respeed,
                                      .refilm = sb_sliding_rub,
                                      .resurface = sb_sliding_rough_contact,
                                      .update_errors = sb_separate_update_errors,
                                      .warn_limit = sb_ring_warn_limit,
                                      .dry_gap = sb_ring_dry_gap};

static const SbContactLaw coupled = {
    .shares = true,
    .friction_over_speed = true,
    .film = "reynolds with asperities",
    .reason = "models.asperities = coupled: film and asperities carry the load together",
    .solve = sb_coupled_solve,
    .rest = sb_coupled_rest,
    .take = sb_coupled_take,
    .respeed = sb_ring_respeed,
    .refilm = sb_coupled_refilm,
    .resurface = sb_sliding_rough_contact,
    .update_errors = sb_coupled_update_errors,
    .warn_limit = sb_ring_warn_limit,
    .dry_gap = sb_ring_dry_gap};

// Rows of gaskets differ in `shares` only.
#define EDGES                                                                                      \
  .closed_film = true, .friction_over_speed = true, .around_stem = true,                           \
  .detached_scatter = SB_EDGE_DETACHED_SCATTER, .film = edge_film, .reason = edge_reason,          \
  .solve = sb_edge_solve, .respeed = sb_edge_respeed, .refilm = sb_edge_contact,                   \
  .resurface = sb_edge_resurface, .update_errors = sb_edge_update_errors,                          \
  .warn_limit = sb_edge_warn_limit, .dry_gap = sb_edge_dry_gap

static const SbContactLaw edges = {EDGES};
static const SbContactLaw edges_share = {.shares = true, EDGES};

static const SbContactLaw *const laws[][2] = {
    [SB_VALVE_PISTON] =
        {[SB_MODEL_ASPERITIES_BESIDE] = &separate, [SB_MODEL_ASPERITIES_COUPLED] = &coupled},
    [SB_VALVE_GASKET] =
        {[SB_MODEL_ASPERITIES_BESIDE] = &edges, [SB_MODEL_ASPERITIES_COUPLED] = &edges_share},
};

const SbContactLaw *sb_contact_law(const SbModel *model) {
  return laws[model->kind][model->asperities];
}

const SbContactLaw *sb_contact_law_of(const SbModel *model, const SbSealState *state) {
  return state->load_net > 0 ? sb_contact_law(model) : &separate;
}

bool sb_contact_solves_film(const SbModel *model) {
  const SbContactLaw *law = sb_contact_law(model);
  return !law->closed_film && (law->shares || sb_film_kind(model->film)->coupled);
}
