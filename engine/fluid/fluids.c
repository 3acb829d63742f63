// Coefficients of the fluids, as published in the papers that each fluid names as its sources.
// An uncertainty is the paper's or, with a minus, estimated here.
#include "engine/fluid/fluid.h"

#include <math.h>

// Tables of numbers keep their own lines.
// clang-format off

#define TERMS(table) .term = (table), .count = sizeof(table) / sizeof *(table)

// ---- HFA-134a
static const double r134a[][SB_TERM_SIZE] = {
    {0.05586817, 2, -0.5}, {0.498223, 1, 0}, {0.02458698, 3, 0}, {0.0008570145, 6, 0},
    {0.0004788584, 6, 1.5}, {-1.800808, 1, 1.5}, {0.2671641, 1, 2}, {-0.04781652, 2, 2},
    {0.01423987, 5, 1, 1}, {0.3324062, 2, 3, 1}, {-0.007485907, 2, 5, 1}, {0.0001017263, 4, 1, 2},
    {-0.5184567, 1, 5, 2}, {-0.08692288, 4, 5, 2}, {0.2057144, 1, 6, 2}, {-0.005000457, 2, 10, 2},
    {0.0004603262, 4, 10, 2}, {-0.003497836, 1, 10, 3}, {0.006995038, 5, 18, 3},
    {-0.01452184, 3, 22, 3}, {-0.0001285458, 10, 50, 4}};
static const SbHelmholtz r134a_equation = {8.314471, 374.18, 4978.830171, 0.32684, TERMS(r134a)};
static const double r134a_viscosity[][3] = {
    {-2.06900719e-5, 1, 0}, {3.56029549e-7, 2, 6}, {2.11101816e-6, 2, 2}, {1.39601415e-5, 2, 0.5},
    {-4.5643502e-6, 2, -2}, {-3.51593275e-6, 3, 0}};
static const SbViscosity r134a_eta = {
    .epsilon = 299.363, .sigma = 0.468932, .chapman = 0.021357e-6, .mass = 102.031,
    .collision = {0.355404, -0.464337, 0.0257353}, .initial = true, .temperature = 374.21,
    .density = 5017.053, TERMS(r134a_viscosity), .free = 2.1476332e-4, .g = {3.163695636},
    .h = {-0.0890173375, 0.100035295}};

// ---- HFA-152a: the paper's modified Benedict-Webb-Rubin equation, integrated to the Helmholtz
// energy
static const double r152a[][SB_TERM_SIZE] = {
    {-3.54657950019, 0, 3}, {-0.364631279956, 0, 4}, {0.0333233330611, 0, 5},
    {-0.68096843383, 1, 0}, {7.35212648103, 1, 0.5}, {-11.2473063781, 1, 1}, {5.49916714298, 1, 2},
    {-2.40186327021, 1, 3}, {-0.0709036446439, 2, 0}, {-0.213200886821, 2, 1},
    {0.197839736733, 2, 2}, {1.82494769827, 2, 3}, {-0.0860546476704, 3, 0}, {0.888137366854, 3, 1},
    {-0.966127347141, 3, 2}, {-0.098522347853, 4, 1}, {0.0183419368634, 5, 2},
    {-0.0338550204069, 5, 3}, {0.0124921100858, 6, 2}, {-0.00221056707104, 7, 2},
    {0.00216879133278, 7, 3}, {-0.00023359769047, 8, 3}, {3.54657950019, 0, 3, 2},
    {0.364631279956, 0, 4, 2}, {-0.0333233330611, 0, 5, 2}, {2.76133830402, 2, 3, 2},
    {-0.0691185710237, 2, 4, 2}, {-0.0333233330611, 2, 5, 2}, {0.782761326856, 4, 3, 2},
    {-0.0345592855118, 4, 4, 2}, {0.137813532067, 4, 5, 2}, {0.186173125815, 6, 3, 2},
    {-0.0341119392899, 6, 4, 2}, {0.0459378440223, 6, 5, 2}, {0.0216470012706, 8, 3, 2},
    {-0.00852798482248, 8, 4, 2}, {0.00620394039717, 8, 5, 2}, {0.00185210291149, 10, 3, 2},
    {0.00101674662709, 10, 4, 2}, {0.00124078807943, 10, 5, 2}};
static const SbHelmholtz r152a_equation = {8.314471, 386.411, 5571.45, 0.275217, TERMS(r152a)};
static const double r152a_viscosity[][3] = {
    {-3.772282824e-6, 1, 0}, {2.647627488e-5, 2, 0}, {-1.578969e-5, 3, 0}, {5.52346488e-6, 4, 0}};
static const SbViscosity r152a_eta = {
    .epsilon = 354.84, .sigma = 0.46115, .chapman = 0.2169614e-6, .mass = 1.0,
    .collision = {0.4425728, -0.5138403, 0.1547566, -0.02821844, 0.001578286},
    .temperature = 386.411, .density = 5571.5367, TERMS(r152a_viscosity), .free = 2.087674344e-5,
    .g = {2.91733}};

// ---- HFO-1234ze(E): the residual viscosity, rho_r^(2/3) T_r^(1/2) times a polynomial, is a sum of
// powers
static const double r1234ze[][SB_TERM_SIZE] = {
    {0.03982797, 4, 1}, {1.812227, 1, 0.223}, {-2.537512, 1, 0.755}, {-0.5333254, 2, 1.24},
    {0.1677031, 3, 0.44}, {-1.323801, 1, 2, 2}, {-0.6694654, 3, 2.2, 2}, {0.8072718, 2, 1.2, 1},
    {-0.7740229, 2, 1.5, 2}, {-0.01843846, 7, 0.9, 1},
    {1.407916, 1, 1.33, 0, 1, 0.728, 1.21, 0.943},
    {-0.4237082, 1, 1.75, 0, 1.61, 0.87, 1.37, 0.642},
    {-0.2270068, 3, 2.11, 0, 1.24, 0.855, 0.98, 0.59}, {-0.805213, 3, 1, 0, 9.34, 0.79, 171, 1.2},
    {0.00994318, 2, 1.5, 0, 5.78, 1.3, 47.4, 1.33},
    {-0.008798793, 1, 1, 0, 3.08, 0.71, 15.4, 0.64}};
static const SbHelmholtz r1234ze_equation = {8.314472, 382.513, 4290.0, 0.313, TERMS(r1234ze)};
static const double r1234ze_viscosity[][3] = {
    {8.61691913e-6, 2.0 / 3.0, -0.5}, {20.83024738e-6, 8.0 / 3.0, -0.5},
    {0.5424369e-6, 20.0 / 3.0, 0.5}, {-10.49684841e-6, 5.0 / 3.0, -1.5},
    {-1.38137689e-6, 17.0 / 3.0, -0.5}};
static const SbViscosity r1234ze_eta = {
    .epsilon = 340.0, .sigma = 0.5017, .above = {-963382e-6, 9614.09e-6, -13.233e-6, 0.0360562e-6},
    .below = {122059.0, -224.741, 1.0}, .initial = true, .temperature = 382.513, .density = 4290.0,
    TERMS(r1234ze_viscosity)};

// ---- Propane, the reference fluid for the viscosity of HFA-227ea: Lemmon, McLinden and Wagner, J.
// Chem. Eng. Data 54 (2009) 3141. Viscosity: Vogel, Kuechenmeister, Bich and Laesecke, J. Phys.
// Chem. Ref. Data 27 (1998) 947.
static const double propane[][SB_TERM_SIZE] = {
    {0.042910051, 4, 1}, {1.7313671, 1, 0.33}, {-2.4516524, 1, 0.8}, {0.34157466, 2, 0.43},
    {-0.46047898, 2, 0.9}, {-0.66847295, 1, 2.46, 1}, {0.20889705, 3, 2.09, 1},
    {0.19421381, 6, 0.88, 1}, {-0.22917851, 6, 1.09, 1}, {-0.60405866, 2, 3.25, 2},
    {0.066680654, 3, 4.62, 2}, {0.017534618, 1, 0.76, 0, 0.963, 1.283, 2.33, 0.684},
    {0.33874242, 1, 2.5, 0, 1.977, 0.6936, 3.47, 0.829},
    {0.22228777, 1, 2.75, 0, 1.917, 0.788, 3.15, 1.419},
    {-0.23219062, 2, 3.05, 0, 2.307, 0.473, 3.19, 0.817},
    {-0.09220694, 2, 2.55, 0, 2.546, 0.8577, 0.92, 1.5},
    {-0.47575718, 4, 8.4, 0, 3.28, 0.271, 18.8, 1.426},
    {-0.017486824, 1, 6.75, 0, 14.6, 0.948, 547.8, 1.093}};
static const SbHelmholtz propane_equation = {8.314472, 369.89, 5000.0, 0.1521, TERMS(propane)};
static const double propane_viscosity[][3] = {
    {3.59873030195e-5, 2, 0}, {-0.000180512188564, 2, 1}, {8.77124888223e-5, 2, 2},
    {-0.000105773052525, 3, 0}, {0.000205319740877, 3, 1}, {-0.00012921093261, 3, 2},
    {5.89491587759e-5, 4, 0}, {-0.0001297400331, 4, 1}, {7.66280419971e-5, 4, 2},
    {-9.59407868475e-6, 5, 0}, {2.10726986598e-5, 5, 1}, {-1.43971968187e-5, 5, 2}};
static const SbViscosity propane_eta = {
    .epsilon = 263.88, .sigma = 0.49748, .chapman = 0.021357e-6, .mass = 44.0956,
    .collision = {0.25104574, -0.47271238, 0.0, 0.060836515}, .initial = true,
    .temperature = 369.825, .density = 5000.0, TERMS(propane_viscosity), .free = 1.61688405374e-3,
    .free_d = 1.0, .g = {2.50053938863, 2.1517543007382995}};

// ---- HFA-227ea
static const double r227ea[][SB_TERM_SIZE] = {
    {2.024341, 1, 0.34}, {-2.60593, 1, 0.77}, {0.4957216, 2, 0.36}, {-0.824082, 2, 0.9},
    {0.06543703, 4, 1}, {-1.02461, 1, 2.82, 1}, {0.6247065, 3, 2.1, 1}, {0.2997521, 6, 0.9, 1},
    {-0.353917, 6, 1.13, 1}, {-1.232043, 2, 3.8, 2}, {-0.8824483, 3, 2.75, 2},
    {0.1349661, 1, 1.5, 0, 0.83, 1.13, 1.72, 0.414},
    {-0.2662928, 2, 2.5, 0, 2.19, 0.71, 5.2, 1.051}, {0.1764733, 1, 2.5, 0, 2.44, 1.2, 2.31, 1.226},
    {0.01536163, 1, 5.4, 0, 3.65, 1.7, 1.02, 1.7},
    {-0.004667185, 4, 4, 0, 8.88, 0.546, 5.63, 0.904},
    {-11.70854, 2, 1, 0, 8.23, 0.896, 50.9, 1.42},
    {0.9114512, 1, 3.5, 0, 2.01, 0.747, 1.56, 0.926}};
static const SbHelmholtz r227ea_equation = {8.3144621, 374.9, 3495.0, 0.357641, TERMS(r227ea)};
static const SbCorresponding r227ea_eta = {
    289.34, 0.5746, {0.76758, 0.254482, -0.0533748}, 3370.0, &propane_equation, &propane_eta,
    0.04409562};

// ---- Ethanol
static const double ethanol[][SB_TERM_SIZE] = {
    {0.058200796, 4, 1}, {0.94391227, 1, 1.04}, {-0.80941908, 1, 2.72}, {0.55359038, 2, 1.174},
    {-1.4269032, 2, 1.329}, {0.13448717, 3, 0.195}, {0.42671978, 1, 2.43, 1},
    {-1.1700261, 1, 1.274, 1}, {-0.92405872, 1, 4.16, 2}, {0.34891808, 3, 3.3, 1},
    {-0.9132772, 3, 4.177, 2}, {0.022629481, 2, 2.5, 1}, {-0.15513423, 2, 0.81, 2},
    {0.21055146, 6, 2.02, 1}, {-0.2199769, 6, 1.606, 1}, {-0.0065857238, 8, 0.86, 1},
    {0.75564749, 1, 2.5, 0, 1.075, 0.779, 1.207, 1.194},
    {0.1069411, 1, 3.72, 0, 0.463, 0.805, 0.0895, 1.986},
    {-0.069533844, 2, 1.19, 0, 0.876, 1.869, 0.581, 1.583},
    {-0.24947395, 3, 3.25, 0, 1.108, 0.694, 0.947, 0.756},
    {0.027177891, 3, 3, 0, 0.741, 1.312, 2.356, 0.495},
    {-0.0009053953, 2, 2, 0, 4.032, 2.054, 27.01, 1.002},
    {-0.12310953, 2, 2, 0, 2.453, 0.441, 4.542, 1.077},
    {-0.08977971, 2, 1, 0, 2.3, 0.793, 1.287, 1.493},
    {-0.39512601, 1, 1, 0, 3.143, 0.313, 3.09, 1.542}};
static const SbHelmholtz ethanol_equation = {8.314472, 514.71, 5930.0, 0.644, TERMS(ethanol)};
static const double ethanol_viscosity[][3] = {
    {0.000131194057, 2, 0}, {-0.000382240694, 2, 1}, {-8.05700894e-5, 3, 0}, {0.000153811778, 3, 1},
    {-0.000110578307, 3, 2}};
static const SbViscosity ethanol_eta = {
    .epsilon = 362.6, .sigma = 0.453, .above = {-1.03116e-6, 3.48379e-8, -6.50264e-12},
    .below = {1.0}, .initial = true, .temperature = 513.9, .density = 5991.0,
    TERMS(ethanol_viscosity), .free = 0.0237222995, .free_d = 1.0, .g = {-3.38264465, 12.7568864}};

// ---- The fluids

#define RANGE       .temperature_min = 233.15, .temperature_max = 353.15
#define MULERO_2012 "Mulero, Cachadina, Parra, J. Phys. Chem. Ref. Data 41 (2012) 043105"
#define AR6         "IPCC AR6, working group I (2021), table 7.SM.7"
// Of pressure, densities of liquid and vapour, viscosity, surface tension and enthalpy.
#define UNCERTAINTY(p, liquid, vapour, eta)                                                        \
  .uncertainty = {p, liquid, vapour, eta, -0.03, -0.005}

// Density [kg/m3], surface tension [mN/m] and number-average molar mass [kg/mol] are the trade's
// typical figures of the grade (Dow Corning 360, Gelest DMS-T).
#define SILICONE(mm2_per_s, density_25_degC, tension, molar_mass)                                  \
  {.name = "silicone-" #mm2_per_s, .label = "Silicone oil " #mm2_per_s " mm²/s",                   \
   .help = "polydimethylsiloxane, by its viscosity at 25 °C",                                      \
   .temperature_min = 248.15, .temperature_max = 353.15, .mass = molar_mass, .gwp100 = NAN,        \
   .grade = 1e-6 * mm2_per_s, .density = density_25_degC, .tension_25 = 1e-3 * tension,            \
   .source = {"typical of the grade", "Shin-Etsu, KF-96 technical data", "typical of the grade"},  \
   .uncertainty = {0.0, -0.01, 0.0, -0.1, -0.05}}

const SbFluid sb_fluids[] = {
    {.name = "custom", .label = "Custom",
     .help = "pressure, viscosity and density as they are set"},
    {.name = "hfa-134a", .label = "HFA-134a", .help = "1,1,1,2-tetrafluoroethane", RANGE,
     .temperature_critical = 374.21, .propellant = true, .mass = 0.102032, .gwp100 = 1530,
     .equation = &r134a_equation, .viscosity = &r134a_eta, .tension_temperature = 374.21,
     .tension = {{0.05801, 1.241}},
     .source = {"Tillner-Roth, Baehr, J. Phys. Chem. Ref. Data 23 (1994) 657",
                "Huber, Laesecke, Perkins, Ind. Eng. Chem. Res. 42 (2003) 3163", MULERO_2012, AR6},
     UNCERTAINTY(0.0002, 0.0005, 0.0005, 0.015)},
    {.name = "hfa-227ea", .label = "HFA-227ea", .help = "1,1,1,2,3,3,3-heptafluoropropane", RANGE,
     .temperature_critical = 374.9, .propellant = true, .mass = 0.17002886, .gwp100 = 3600,
     .equation = &r227ea_equation, .corresponding = &r227ea_eta, .tension_temperature = 374.9,
     .tension = {{0.06127, 1.192}, {-0.009516, 0.9795}, {-0.00192, 1.421}},
     .source = {"Lemmon, Span, J. Chem. Eng. Data 60 (2015) 3745",
                "corresponding states with propane, Huber, Laesecke, Perkins, Ind. Eng. Chem. Res. "
                "42 (2003) 3163", MULERO_2012, AR6},
     UNCERTAINTY(0.004, 0.0005, 0.003, -0.05)},
    {.name = "hfa-152a", .label = "HFA-152a", .help = "1,1-difluoroethane", RANGE,
     .temperature_critical = 386.411, .propellant = true, .mass = 0.066051, .gwp100 = 164,
     .equation = &r152a_equation, .viscosity = &r152a_eta, .viscosity_min = 240.0,
     .tension_temperature = 386.411, .tension = {{0.05808, 1.2115}},
     .source = {"Outcalt, McLinden, J. Phys. Chem. Ref. Data 25 (1996) 605",
                "Krauss, Weiss, Edison, Sengers, Stephan, Int. J. Thermophys. 17 (1996) 731",
                MULERO_2012, AR6},
     UNCERTAINTY(0.0005, 0.001, 0.001, -0.03)},
    {.name = "hfo-1234ze(e)", .label = "HFO-1234ze(E)", .help = "trans-1,3,3,3-tetrafluoropropene",
     RANGE, .temperature_critical = 382.513, .propellant = true, .mass = 0.1140415928,
     .gwp100 = 1.37, .equation = &r1234ze_equation, .viscosity = &r1234ze_eta,
     .tension_temperature = 382.51, .tension = {{0.06158, 1.281}, {0.8247, 6.505}},
     .source = {"Thol, Lemmon, Int. J. Thermophys. 37 (2016) 28",
                "Huber, Assael, Int. J. Refrig. 71 (2016) 39",
                "Mulero, Cachadina, J. Phys. Chem. Ref. Data 43 (2014) 023104", AR6},
     UNCERTAINTY(0.001, 0.001, 0.005, 0.02)},
    {.name = "ethanol", .label = "Ethanol", .help = "the cosolvent alone", RANGE,
     .temperature_critical = 514.71, .mass = 0.04606844, .gwp100 = NAN,
     .equation = &ethanol_equation, .viscosity = &ethanol_eta, .tension_temperature = 513.9,
     .tension = {{0.05, 0.952}},
     .source = {"Schroeder, Penoncello, Schroeder, J. Phys. Chem. Ref. Data 43 (2014) 043102",
                "Kiselev, Ely, Abdulagatov, Huber, Ind. Eng. Chem. Res. 44 (2005) 6916",
                MULERO_2012},
     UNCERTAINTY(0.005, 0.005, 0.005, -0.05)},
    SILICONE(100, 964.0, 20.9, 5.97),
    SILICONE(350, 968.0, 21.1, 13.65),
    SILICONE(1000, 970.0, 21.2, 28.0),
    SILICONE(12500, 974.0, 21.5, 67.7),
};
const int sb_fluid_count = sizeof sb_fluids / sizeof *sb_fluids;
