// Rigid bodies in joints: degrees of freedom, accelerations and joint reactions by multipliers.
//
// Newton and Euler for each part with the joints' conditions as Lagrange multipliers (thesis ch. 4,
// eq. 4.2, 4.16, 4.17; its Euler-angle momenta 4.11-4.13 are misprinted, so that spins and unit
// quaternions are used instead):
//
//   [ M  J' ] [ a  ]   [ applied - gyroscopic ]
//   [ J  0  ] [ -l ] = [ -(dJ/dt) velocity    ]
//
// J has 6 rows for a fixed joint, 5 for a translational or revolute one, 4 for a cylindrical, 3 for
// a spherical one. Gruebler's count 6 (n - 1) - sum of constraints is compared with the rank of J:
// conditions that repeat each other or a part that nothing holds are named. SI units, ground frame.
// Leaves out: flexible parts, clearance, friction inside joints (apply it as a force).
#pragma once

#include "engine/base/status.h"

// The ground is behind the parts that move.
enum { SB_BODIES_MAX = 15, SB_GROUND = SB_BODIES_MAX, SB_JOINTS_MAX = 20, SB_BODY_NAME = 32 };

typedef struct {
  char name[SB_BODY_NAME];
  double mass;                 // kg
  double inertia[3];           // principal moments about the centre of mass, body axes, kg m2
  double position[3];          // centre of mass, m
  double orientation[4];       // unit quaternion w, x, y, z: body to ground
  double velocity[3], spin[3]; // m/s, rad/s, ground axes
  double force[3], torque[3];  // applied at the centre of mass, N, N m
} SbBody;

// Conditions: 6, 5, 5, 3, 4.
typedef enum {
  SB_JOINT_FIXED,
  SB_JOINT_TRANSLATIONAL,
  SB_JOINT_REVOLUTE,
  SB_JOINT_SPHERICAL = 4, // a point in common, any turn
  SB_JOINT_CYLINDRICAL,   // slides along the axis and turns about it
} SbJointKind;

// Joint between two bodies.
typedef struct {
  SbJointKind kind;
  size_t body[2];
  double point[2][3];    // its point in either body's axes, from the centre [m]
  double frame[2][3][3]; // unit vectors in either body, the joint's axis first
} SbJoint;

typedef struct {
  size_t bodies, joints; // bodies that move
  SbBody body[SB_BODIES_MAX + 1];
  SbJoint joint[SB_JOINTS_MAX];
} SbAssembly;

enum {
  SB_ASSEMBLY_ROWS = 6 * SB_JOINTS_MAX,
  SB_ASSEMBLY_COLUMNS = 6 * (SB_BODIES_MAX + 1),
  SB_ASSEMBLY_SIZE = SB_ASSEMBLY_ROWS + SB_ASSEMBLY_COLUMNS
};

// The joints' conditions at the present positions and speeds.
typedef struct {
  size_t rows;
  double jacobian[SB_ASSEMBLY_ROWS][SB_ASSEMBLY_COLUMNS]; // of (velocity, length x spin)
  double rate[SB_ASSEMBLY_ROWS];  // what the rows' second derivative has beside J a [m/s2]
  double error[SB_ASSEMBLY_ROWS]; // violation of the position conditions [m]
  bool turns[SB_ASSEMBLY_ROWS];   // the condition is one on turns, not on the joint's point
  size_t joint[SB_ASSEMBLY_ROWS];
} SbAssemblyConditions;

// Work memory of the functions below, whose content means nothing between calls, but that
// sb_assembly_slide() knows a tangent found with it; one serves any assembly, but one thread at a
// time. Half a megabyte: not for the stack.
typedef struct {
  SbAssemblyConditions conditions;
  double matrix[SB_ASSEMBLY_SIZE * SB_ASSEMBLY_SIZE], right[SB_ASSEMBLY_SIZE];
  int pivot[SB_ASSEMBLY_SIZE];
  double tangent_jacobian[SB_ASSEMBLY_ROWS][SB_ASSEMBLY_COLUMNS]; // of the last tangent
} SbAssemblyWork;

typedef struct {
  int gruebler;       // 6 (n - 1) - constraints
  int constraints;    // sum over joints
  int redundant;      // of them, that repeat others
  int freedom;        // real degrees of freedom, 6 (n - 1) - rank
  char text[SB_TEXT]; // one sentence: count, and what is over- or under-constrained
} SbMobility;

// What a joint does to its first body (the second gets the opposite), at the joint's point.
typedef struct {
  double force[3], torque[3]; // N, N m
} SbReaction;

typedef struct {
  double acceleration[SB_BODIES_MAX][3], spin_rate[SB_BODIES_MAX][3]; // m/s2, rad/s2
  SbReaction reaction[SB_JOINTS_MAX];
} SbAssemblyForces;

// Nothing but the ground.
void sb_assembly_start(SbAssembly *assembly);

// Appends a body at rest, unrotated.
SbStatus sb_assembly_add(SbAssembly *assembly, const char *name, double mass,
                         const double inertia[3], const double position[3], SbReport *report);

// Appends a joint of bodies i and j, one of which may be SB_GROUND, through `point`, ground frame,
// as they stand; `axis` is that of the sliding or turning (any if fixed).
SbStatus sb_assembly_join(SbAssembly *assembly, SbJointKind kind, size_t i, size_t j,
                          const double point[3], const double axis[3], SbReport *report);

// Adds a force [N] at a point, ground frame, to what is applied to a body.
void sb_assembly_apply(SbAssembly *assembly, size_t body, const double force[3],
                       const double point[3]);
void sb_assembly_clear_forces(SbAssembly *assembly);

// Counts. SB_ERROR_INFEASIBLE, with the text of `mobility`, unless there are exactly `expected`
// degrees of freedom and no redundant conditions; expected < 0 accepts any freedom.
SbStatus sb_assembly_mobility(SbMobility *mobility, const SbAssembly *assembly, int expected,
                              SbAssemblyWork *work, SbReport *report);

// Accelerations and reactions under the applied forces. SB_ERROR_INFEASIBLE if conditions repeat
// each other (reactions are then not unique).
SbStatus sb_assembly_forces(SbAssemblyForces *forces, const SbAssembly *assembly,
                            SbAssemblyWork *work, SbReport *report);

// Motion along the single degree of freedom: velocity of every centre [m/s] and spin [rad/s] per
// 1 m/s of one body's centre along an axis, and the mass that a push there sees [kg].
typedef struct {
  size_t body;
  double axis[3]; // unit
  double velocity[SB_BODIES_MAX][3], spin[SB_BODIES_MAX][3];
  double mass; // sum of m velocity^2 + spin . I spin
} SbAssemblyTangent;

// Null vector of the joints' Jacobian at the present positions, from its QR factorisation.
// SB_ERROR_INFEASIBLE, with Gruebler's count, unless freedom is 1, nothing repeats and `body` moves
// along `axis`.
SbStatus sb_assembly_tangent(SbAssemblyTangent *tangent, const SbAssembly *assembly, size_t body,
                             const double axis[3], SbAssemblyWork *work, SbReport *report);

// Moves all parts along their freedom until the tangent's body is `distance` [m] further along the
// axis, onto the joints by Newton's method, and sets all speeds to those of `speed` [m/s] there.
// `tangent` is that of the present place and becomes that of the new one. *error (may be NULL) is
// what the joints were violated by before they were brought back [m]. Errors as above, and
// SB_ERROR_NOT_CONVERGED if the parts cannot get there; they may then have moved.
SbStatus sb_assembly_slide(SbAssembly *assembly, SbAssemblyTangent *tangent, double distance,
                           double speed, double *error, SbAssemblyWork *work, SbReport *report);

// The valve's parts, and their indices in sb_assembly_valve.
enum {
  SB_VALVE_HOUSING,
  SB_VALVE_STEM_CENTRE,
  SB_VALVE_STEM_TOP,
  SB_VALVE_STEM_BOTTOM,
  SB_VALVE_INNER_SEAL,
  SB_VALVE_OUTER_SEAL,
  SB_VALVE_BLOCK,
  SB_VALVE_PARTS,
};

// The joints of thesis table 4.3 in its order.
enum {
  SB_VALVE_HOUSING_GROUND,
  SB_VALVE_CENTRE_TOP,
  SB_VALVE_BOTTOM_CENTRE,
  SB_VALVE_INNER_CENTRE,
  SB_VALVE_OUTER_CENTRE,
  SB_VALVE_BLOCK_BOTTOM,
  SB_VALVE_BLOCK_GROUND,
  SB_VALVE_JOINTS,
};
enum { SB_JOINT_NONE = SB_JOINT_REVOLUTE + 1 }; // no SbJointKind: left out

// Mass [kg] and moments of inertia about the valve's axis and across it through the centre [kg m2].
typedef struct {
  double mass, axial, transverse;
} SbValvePart;

typedef struct {
  SbValvePart part[SB_VALVE_PARTS];
  int joint[SB_VALVE_JOINTS]; // SbJointKind or SB_JOINT_NONE
} SbValveParts;

// Eight parts (thesis table 4.1) and the joints between them, axis along x (in-stroke > 0),
// everything on the axis. Where the parts sit along it is not given there: ours, without effect on
// axial loads.
SbStatus sb_assembly_valve(SbAssembly *assembly, const SbValveParts *parts, SbReport *report);

// "stem top"; borrowed.
const char *sb_valve_part_name(int part);

// "fixed", "translational", "revolute"; borrowed.
const char *sb_joint_kind_name(SbJointKind kind);
