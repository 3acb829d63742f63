// Rigid bodies connected by joints: degrees of freedom, accelerations and joint reactions.
//
// Newton-Euler equations of each body with the joints' conditions as Lagrange multipliers l (thesis
// ch. 4, eq. 4.2, 4.16, 4.17; unit quaternions replace its Euler angles, whose momenta 4.11-4.13
// are misprinted). J' is the transpose of J; J' l are the forces of the joints on the bodies:
//
//   [ M  J' ] [ a  ]   [ applied - gyroscopic ]
//   [ J  0  ] [ -l ] = [ -(dJ/dt) velocity    ]
//
// A fixed joint has 6 conditions, a translational or revolute one 5, a cylindrical one 4, a
// spherical one 3. Gruebler's count 6 (n - 1) - conditions is compared with the rank of J;
// redundant conditions and unconstrained parts are reported by name. All vectors are in the ground
// frame unless stated otherwise. Functions may be called concurrently with different assemblies and
// work memories. Not modelled: flexible parts, clearance, friction in joints (apply it as a force).
#pragma once

#include "engine/base/status.h"

// Limits. Bodies are numbered from 0 in the order of their creation; SB_GROUND is the number of the
// ground.
enum { SB_BODIES_MAX = 15, SB_GROUND = SB_BODIES_MAX, SB_JOINTS_MAX = 20, SB_BODY_NAME = 32 };

// A rigid body.
typedef struct {
  char name[SB_BODY_NAME];
  double mass;                 // [kg]
  double inertia[3];           // principal moments about the centre of mass, body axes [kg m2]
  double position[3];          // centre of mass [m]
  double orientation[4];       // unit quaternion w, x, y, z: body to ground
  double velocity[3], spin[3]; // of the centre; angular velocity [m/s], [rad/s]
  double force[3], torque[3];  // sum of applied forces; torque about the centre of mass [N], [N m]
} SbBody;

// Kind of a joint. `axis` is that of sb_assembly_join().
typedef enum {
  SB_JOINT_FIXED,         // 6 conditions
  SB_JOINT_TRANSLATIONAL, // slides along the axis
  SB_JOINT_REVOLUTE,      // turns about the axis
  SB_JOINT_SPHERICAL = 4, // common point, free rotation
  SB_JOINT_CYLINDRICAL,   // slides along the axis and turns about it
} SbJointKind;

// A joint between two bodies.
typedef struct {
  SbJointKind kind;
  size_t body[2];        // numbers of the bodies, or SB_GROUND
  double point[2][3];    // the joint's point relative to either centre of mass, body axes [m]
  double frame[2][3][3]; // three unit vectors in either body's axes; the first is the joint's axis
} SbJoint;

// Bodies and joints. Start with sb_assembly_start(); nothing has to be freed.
typedef struct {
  size_t bodies, joints;          // numbers in use, without the ground
  SbBody body[SB_BODIES_MAX + 1]; // the last is the ground
  SbJoint joint[SB_JOINTS_MAX];
} SbAssembly;

// Sizes of the linear systems.
enum {
  SB_ASSEMBLY_ROWS = 6 * SB_JOINTS_MAX,
  SB_ASSEMBLY_COLUMNS = 6 * (SB_BODIES_MAX + 1),
  SB_ASSEMBLY_SIZE = SB_ASSEMBLY_ROWS + SB_ASSEMBLY_COLUMNS
};

// The joints' conditions at the present positions and velocities, one row each.
typedef struct {
  size_t rows; // number of conditions
  // [rows][6 * bodies]: coefficients of the velocity (3) and of the length times the spin (3) of
  // each body; the length is that of sb_bodies_conditions().
  double jacobian[SB_ASSEMBLY_ROWS][SB_ASSEMBLY_COLUMNS];
  double rate[SB_ASSEMBLY_ROWS];  // second time derivative minus J a [m/s2]
  double error[SB_ASSEMBLY_ROWS]; // violation of the position condition [m]
  bool turns[SB_ASSEMBLY_ROWS];   // true: condition on rotation; false: on the joint's point
  size_t joint[SB_ASSEMBLY_ROWS]; // number of the joint
} SbAssemblyConditions;

// Work memory of the functions below, 0.6 MB: allocate it, do not put it on the stack. It needs no
// initialisation and serves any assembly, one thread at a time. sb_assembly_slide() must get the
// one that computed its tangent, unchanged since.
typedef struct {
  SbAssemblyConditions conditions;
  double matrix[SB_ASSEMBLY_SIZE * SB_ASSEMBLY_SIZE], right[SB_ASSEMBLY_SIZE];
  int pivot[SB_ASSEMBLY_SIZE];
  double tangent_jacobian[SB_ASSEMBLY_ROWS][SB_ASSEMBLY_COLUMNS]; // of the last tangent
} SbAssemblyWork;

// Degrees of freedom of an assembly.
typedef struct {
  int gruebler;       // 6 (n - 1) - constraints
  int constraints;    // number of conditions of all joints
  int redundant;      // number of conditions that follow from others
  int freedom;        // degrees of freedom, 6 (n - 1) - rank
  char text[SB_TEXT]; // one clause: the counts, and what is over- or under-constrained
} SbMobility;

// Reaction of a joint on its first body (`i` of sb_assembly_join()); the second body gets the
// opposite. The torque is about the joint's point.
typedef struct {
  double force[3], torque[3]; // ground frame [N], [N m]
} SbReaction;

// Accelerations of the bodies and reactions of the joints.
typedef struct {
  // Of the centres of mass [m/s2]; of the angular velocities [rad/s2].
  double acceleration[SB_BODIES_MAX][3], spin_rate[SB_BODIES_MAX][3];
  SbReaction reaction[SB_JOINTS_MAX];
} SbAssemblyForces;

// Initialises *assembly with the ground only.
void sb_assembly_start(SbAssembly *assembly);

// Appends a body at rest, with its axes parallel to the ground's. `name` is copied (truncated to
// SB_BODY_NAME - 1 bytes). `inertia` are the principal moments [kg m2], `position` is the centre of
// mass [m]. SB_ERROR_RANGE: no more space, a value that is not positive, or a moment that exceeds
// the sum of the others.
SbStatus sb_assembly_add(SbAssembly *assembly, const char *name, double mass,
                         const double inertia[3], const double position[3], SbReport *report);

// Appends a joint of the bodies i and j, one of which may be SB_GROUND, at `point` [m] in their
// present positions. `axis` is the direction of sliding or turning, of any length > 0 (ignored by
// FIXED and SPHERICAL, but not zero). SB_ERROR_RANGE: no more space. SB_ERROR_INPUT: i = j, a
// number that does not exist, or a zero axis.
SbStatus sb_assembly_join(SbAssembly *assembly, SbJointKind kind, size_t i, size_t j,
                          const double point[3], const double axis[3], SbReport *report);

// Adds a force [N] that acts at `point` [m] to the applied force and torque of a body.
void sb_assembly_apply(SbAssembly *assembly, size_t body, const double force[3],
                       const double point[3]);

// Sets the applied forces and torques of all bodies to zero.
void sb_assembly_clear_forces(SbAssembly *assembly);

// Counts the degrees of freedom at the present positions. SB_ERROR_INFEASIBLE, with mobility->text
// in the report: redundant conditions, or another number than `expected` (< 0: any number).
// *mobility is also set after this error.
SbStatus sb_assembly_mobility(SbMobility *mobility, const SbAssembly *assembly, int expected,
                              SbAssemblyWork *work, SbReport *report);

// Computes accelerations and reactions under the applied forces. SB_ERROR_INFEASIBLE: redundant
// conditions (reactions are not unique).
SbStatus sb_assembly_forces(SbAssemblyForces *forces, const SbAssembly *assembly,
                            SbAssemblyWork *work, SbReport *report);

// Motion along a single degree of freedom, per 1 m/s of the velocity component of one body's centre
// along an axis.
typedef struct {
  size_t body;                       // number of that body
  double axis[3];                    // unit vector
  double velocity[SB_BODIES_MAX][3]; // velocity of each centre of mass [m/s per m/s]
  double spin[SB_BODIES_MAX][3];     // angular velocity [rad/s per m/s]
  double mass;                       // effective mass at that body along the axis [kg]
} SbAssemblyTangent;

// Computes the motion at the present positions: the null vector of the joints' Jacobian. `axis`
// need not have length 1. SB_ERROR_INFEASIBLE, with Gruebler's count: the freedom is not 1,
// conditions are redundant, or `body` does not move along `axis`.
SbStatus sb_assembly_tangent(SbAssemblyTangent *tangent, const SbAssembly *assembly, size_t body,
                             const double axis[3], SbAssemblyWork *work, SbReport *report);

// Moves all bodies along the single degree of freedom until the tangent's body has moved by
// `distance` [m] along the axis. Sets all velocities to those of `speed` [m/s] at the new position.
// `tangent` must be that of the present position (sb_assembly_tangent() with the same `work`) and
// becomes that of the new one. *error (NULL: not wanted) receives the largest violation of the
// joints before its correction [m]. SB_ERROR_INFEASIBLE as for sb_assembly_tangent();
// SB_ERROR_NOT_CONVERGED: the position cannot be reached. After an error the bodies may have moved.
SbStatus sb_assembly_slide(SbAssembly *assembly, SbAssemblyTangent *tangent, double distance,
                           double speed, double *error, SbAssemblyWork *work, SbReport *report);

// Numbers of the valve's bodies in sb_assembly_valve().
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

// Numbers of the valve's joints, in the order of thesis table 4.3.
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
// Value of SbValveParts.joint: this joint is omitted.
enum { SB_JOINT_NONE = SB_JOINT_REVOLUTE + 1 };

// Inertia of a part, about its centre of mass.
typedef struct {
  double mass, axial, transverse; // [kg]; moments about the valve's axis and across it [kg m2]
} SbValvePart;

// Inertia of all parts, and the kinds of the joints.
typedef struct {
  SbValvePart part[SB_VALVE_PARTS]; // by SB_VALVE_HOUSING, ...
  int joint[SB_VALVE_JOINTS]; // by SB_VALVE_HOUSING_GROUND, ...: SbJointKind, or SB_JOINT_NONE
} SbValveParts;

// Initialises *assembly and creates the valve's bodies (thesis table 4.1) and joints in it; the
// axis is x, positive into the canister, and all centres are on it. Their positions along the axis
// are our choice; they do not affect axial loads. Errors as for sb_assembly_add() and
// sb_assembly_join().
SbStatus sb_assembly_valve(SbAssembly *assembly, const SbValveParts *parts, SbReport *report);

// Returns the name of a part (SB_VALVE_HOUSING, ...), such as "stem top"; static.
const char *sb_valve_part_name(int part);

// Returns the name of a kind, such as "fixed"; static.
const char *sb_joint_kind_name(SbJointKind kind);
