#include "engine/valve/param_equation.h"

#include <string.h>

// The longest prefix of a key counts.
static const SbParamEquation table[] = {
    {"seal.section_diameter", "squeeze (d − g)/d, stretch (D − 2g − ID)/ID", "Parker ORD 5700",
     "engine/contact/gland.h"},
    {"seal.inner_diameter", "stretch (D − 2g − ID)/ID, squeeze (d − g)/d", "Parker ORD 5700",
     "engine/contact/gland.h"},
    {"seal.modulus", "2/E′ = Σ (1 − ν²)/E, load F ∼ E d²", "thesis 5.8; Johnson 1985",
     "engine/contact"},
    {"seal.poisson_ratio", "2/E′ = Σ (1 − ν²)/E, K = E/(3 (1 − 2ν))", "thesis 5.8",
     "engine/contact"},
    {"seal.mooney_share", "W = c₁(J^−⅔ I₁ − 3) + c₂(J^−4/3 I₂ − 3) + K/2 (J − 1)²",
     "Mooney 1940, Rivlin 1948", "engine/contact/ring"},
    {"seal.", "an outline of lines and arcs, meshed for W = c₁(J^−⅔ I₁ − 3) + … + K/2 (J − 1)²",
     "Mooney 1940, Rivlin 1948", "engine/contact/ring"},
    {"storage.", "E(t) = E₀ (1 − Σ gᵢ (1 − exp(−t/(a_T τᵢ))))",
     "Prony; Williams, Landel, Ferry 1955", "engine/rubber/rubber_time.h"},
    {"rubber.", "E(t) = E₀ (1 − Σ gᵢ (1 − exp(−t/(a_T τᵢ))))",
     "Prony; Williams, Landel, Ferry 1955", "engine/rubber/rubber_time.h"},
    {"rubber.network", "scission as exp(−k t), k by Arrhenius; set of two networks",
     "Tobolsky 1960", "engine/rubber/rubber_time.h"},
    {"rubber.swell", "uptake M(t)/M∞ of a round section (5.23), volumes additive", "Crank 1975",
     "engine/rubber/rubber_time.h"},
    {"rubber.density", "uptake M(t)/M∞ of a round section (5.23), volumes additive", "Crank 1975",
     "engine/rubber/rubber_time.h"},
    {"rubber.diffusi", "D(T) = D₀ exp(−E_D/R (1/T − 1/T₀)), ∂c/∂t = D ∇²c", "Fick; Crank 1975",
     "engine/permeation"},
    {"rubber.permeability", "J = P S_g Δp, P(T) = P₀ exp(−E_P/R (1/T − 1/T₀))",
     "Fick, Henry; Crank 1975", "engine/permeation"},
    {"rubber.water_permeability", "J = P S_g Δp, P(T) = P₀ exp(−E_P/R (1/T − 1/T₀))",
     "Fick, Henry; Crank 1975", "engine/permeation"},
    {"rubber.glass_temperature", "E(T) = E₀ T/T₀ + E_g/(1 + (t/τ)^0.7), τ = 100 s a_T",
     "Williams, Landel, Ferry 1955; ISO 1432", "engine/rubber/rubber_time.h"},
    {"rubber.thermal_expansion", "d(T) = d (1 + α (T − T₀))", "linear expansion",
     "engine/valve/model.c"},
    {"gland.floor_friction", "|τ| ≤ m n at every node, with its history", "Coulomb",
     "engine/contact/ring/ring_drag.c"},
    {"gland.wall_friction", "|τ| ≤ m n at every node, with its history", "Coulomb",
     "engine/contact/ring/ring_drag.c"},
    {"gland.", "squeeze (d − g)/d, fill = ring's volume over the groove's", "Parker ORD 5700",
     "engine/contact/gland.h"},
    {"bore.diameter", "squeeze (d − g)/d, friction's area: width × πD", "Parker ORD 5700",
     "engine/contact/gland.h"},
    {"bore.entry", NULL, NULL, NULL}, // for the drawing only
    {"bore.land_length", NULL, NULL, NULL},
    {"bore.vent", "dp/dt = K (Q_in − Q_out)/V, Q = C_d A √(2Δp/ρ)", "orifice flow",
     "engine/mechanism/chamber.h"},
    {"bore.refill", "dp/dt = K (Q_in − Q_out)/V, Q = C_d A √(2Δp/ρ)", "orifice flow",
     "engine/mechanism/chamber.h"},
    {"bore.", "past the edge at x = e: W = ∫ p dx over what is left of the contact", "statics",
     "engine/valve/sliding.c"},
    {"housing.permea", "J = P (A/L) Δp", "Fick, Henry; Crank 1975", "engine/permeation"},
    {"housing.water_permeability", "J = P (A/L) Δp", "Fick, Henry; Crank 1975",
     "engine/permeation"},
    {"housing.stop", "F = k δ, rebound speed = e × speed", "Newton", "engine/mechanism"},
    {"housing.thermal_expansion", "D(T) = D (1 + α (T − T₀))", "linear expansion",
     "engine/valve/model.c"},
    {"housing.", "2/E′ = Σ (1 − ν²)/E", "thesis 5.8", "engine/contact"},
    {"fluid.name", "p_v, ρ, η, γ from the residual Helmholtz energy α(δ, τ)",
     "by fluid: sealbench fluid", "engine/fluid"},
    {"fluid.ethanol", "p = Σ xᵢ pᵢ, ln η = Σ xᵢ ln ηᵢ", "Raoult; Grunberg, Nissan 1949",
     "engine/fluid"},
    {"fluid.viscosity", "h³ p′ = 6 η u (h − h*)", "Reynolds 1886", "engine/film"},
    {"fluid.pressure_viscosity", "η(p) = η exp(α p)", "Barus 1893", "engine/film"},
    {"fluid.eyring_stress", "γ̇ = (τ₀/η) sinh(τ/τ₀)", "Eyring 1936", "engine/film"},
    {"fluid.rupture_pressure", "h³ p′ = 6 η u (h − h*), p = p_c behind the rupture", "Elrod 1981",
     "engine/film"},
    {"fluid.rest_film", "∂(θh)/∂t + ∂q/∂x = 0", "Elrod 1981", "engine/film"},
    {"fluid.density", "dose = V ρ × share filled", "docs/physics.md", "engine/mechanism"},
    {"fluid.vapour_viscosity", "q = h²/(v L) ∫ Q(δ) dp", "Berman 1965; Clausing 1932",
     "engine/permeation/slit.h"},
    {"fluid.contact_angle", "Δp + 2γ cos θ/u drives the liquid", "Young, Laplace",
     "engine/permeation"},
    {"canister.", "gauge pressure = p_v(T) − ambient", "by fluid: sealbench fluid", "engine/fluid"},
    {"chamber.", "dp/dt = K (Q_in − Q_out)/V, Q = C_d A √(2Δp/ρ)", "orifice flow",
     "engine/mechanism/chamber.h"},
    {"stem.spring", "F = F₀ + k s", "Hooke", "engine/mechanism"},
    {"stem.chamber", "V = bore − stem − rings, between the grooves' middles", "geometry",
     "engine/mechanism/chamber.h"},
    {"stem.seal_spacing", "V = bore − stem − rings, between the grooves' middles", "geometry",
     "engine/mechanism/chamber.h"},
    {"stem.nose", NULL, NULL, NULL},
    {"stem.shoulder", NULL, NULL, NULL},
    {"stem.rod", NULL, NULL, NULL},
    {"stem.pressure_diameter", "F_p = p π D_p²/4", "statics", "engine/mechanism"},
    {"stem.", "m s″ = drive + pressure − spring − friction + stops", "Newton", "engine/mechanism"},
    {"surface.hamaker_constant", "p = A_H/(6π h³), cut off at 0.165 nm", "thesis 5.17",
     "engine/contact/rough"},
    {"surface.work_of_adhesion", "P = K a³/R − √(6π w K a³)", "Johnson, Kendall, Roberts 1971",
     "engine/contact/rough"},
    {"surface.", "A_a = π²(ζβσ)² A F₂(λ), p_a = (8√2/15) π(ζβσ)² √(σ/β) E′ F₅⸝₂(λ)",
     "Greenwood, Tripp 1970; thesis 5.11 to 5.13", "engine/contact/rough"},
    {"friction.stribeck_speed", "F = F_k (1 + (r − 1) exp(−v/v_s))", "Stribeck 1902",
     "engine/mechanism"},
    {"friction.tangential_stiffness", "F = k s before it slips", "docs/physics.md",
     "engine/mechanism"},
    {"friction.breakaway",
     "ratio: F_s = r (τ₀ A_dry + m W_dry); ageing: τ₀ A(t) (1 + B ln(1 + t/t_c)) + m W",
     "docs/physics.md", "engine/valve/breakaway.h"},
    {"friction.ageing", "F_s = τ₀ A(t) (1 + B ln(1 + t/t_c)) + m W", "docs/physics.md",
     "engine/valve/breakaway.h"},
    {"friction.dwell", "F_s = (r + c ln(1 + t/t_d)) (τ₀ A_dry + m W_dry)", "docs/physics.md",
     "engine/valve/breakaway.h"},
    {"friction.static_ratio", "F_s = (r + c ln(1 + t/t_d)) (τ₀ A_dry + m W_dry)", "docs/physics.md",
     "engine/valve/breakaway.h"},
    {"friction.", "F_b = τ₀ A_a + m W, F_v = min(η u/h, τ₀)(A − A_a)", "thesis 5.14 to 5.16",
     "engine/valve/sliding.c"},
    {"drive.", "m s″ = drive + pressure − spring − friction + stops", "Newton", "engine/mechanism"},
    {"people.", "share who press it = Φ((F_mean − F_peak)/σ)", "normal distribution",
     "engine/valve"},
    {"life.", "r(n) = r₁ + (r₀ − r₁) exp(−n/n_e)", "docs/physics.md", "engine/valve"},
    {"rig.", "m s″ = k (u t − s) − friction", "thesis 3.3, 3.4", "engine/mechanism"},
    {"part.", "M q″ + Jᵀλ = f, J q″ = −J′ q′", "Lagrange; thesis tables 4.1 and 4.3",
     "engine/mechanism"},
    {"joint.", "M q″ + Jᵀλ = f, J q″ = −J′ q′", "Lagrange; thesis tables 4.1 and 4.3",
     "engine/mechanism"},
    {"shelf.", "loss = Σ over months (J_rubber + J_contact + J_housing)",
     "Fick; Persson, Yang 2008", "engine/permeation"},
};

static size_t shared(const char *key, const char *prefix) {
  const size_t length = strlen(prefix);
  return strncmp(key, prefix, length) == 0 ? length : 0;
}

const SbParamEquation *sb_param_equation(SbParamId id) {
  const SbParam *param = sb_param(id);
  const char *key = param->parent >= 0 ? sb_param((SbParamId)param->parent)->key : param->key;
  const SbParamEquation *best = NULL;
  size_t longest = 0;
  for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
    const size_t length = shared(key, table[i].prefix);
    if (length > longest) {
      longest = length;
      best = &table[i];
    }
  }
  return best != NULL && best->equation != NULL ? best : NULL;
}
