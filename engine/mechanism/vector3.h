// Vectors of three and unit quaternions (w, x, y, z). Private to engine/mechanism and app/cad.
// Outputs may be the same arrays as inputs. The functions have no state.
#pragma once

#include <math.h>
#include <string.h>

// Writes the cross product a x b to `out`.
static inline void cross(double out[3], const double a[3], const double b[3]) {
  double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
  double z = a[0] * b[1] - a[1] * b[0];
  out[0] = x;
  out[1] = y;
  out[2] = z;
}

// Returns the scalar product of a and b.
static inline double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Writes the rotation matrix of a unit quaternion, by rows: ground vector = R body vector.
static inline void rotation(double r[9], const double q[4]) {
  double w = q[0], x = q[1], y = q[2], z = q[3];
  double m[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                 2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                 2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
  memcpy(r, m, sizeof m);
}

// Writes R a, with R [9] by rows (body to ground).
static inline void turn(double out[3], const double r[9], const double a[3]) {
  double x = dot(r, a), y = dot(r + 3, a), z = dot(r + 6, a);
  out[0] = x;
  out[1] = y;
  out[2] = z;
}

// Writes the transpose of R times a, with R [9] by rows (ground to body).
static inline void turn_back(double out[3], const double r[9], const double a[3]) {
  double x = r[0] * a[0] + r[3] * a[1] + r[6] * a[2];
  double y = r[1] * a[0] + r[4] * a[1] + r[7] * a[2];
  double z = r[2] * a[0] + r[5] * a[1] + r[8] * a[2];
  out[0] = x;
  out[1] = y;
  out[2] = z;
}

// Writes the quaternion product a b: the rotation b, followed by the rotation a.
static inline void multiply(double out[4], const double a[4], const double b[4]) {
  double q[4] = {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
                 a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
                 a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
                 a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
  memcpy(out, q, sizeof q);
}

// Scales q to length 1.
static inline void normalise(double q[4]) {
  double size = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int i = 0; i < 4; i++) {
    q[i] /= size;
  }
}
