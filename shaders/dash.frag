#version 330 core
// Dashed lines: as solid ones, times the coverage of the two dashes of the pattern.
in vec4 v_color;
in vec4 v_extra;
uniform vec4 pattern; // on, off, on, off in device pixels
out vec4 fragment;

float dash(float at, float length) {
  return clamp(min(at, length - at) + 0.5, 0.0, 1.0);
}

void main() {
  float across = clamp(v_extra.y + 0.5 - abs(v_extra.x), 0.0, 1.0);
  float along = clamp(min(v_extra.z, v_extra.w - v_extra.z) + 0.5, 0.0, 1.0);
  float period = pattern.x + pattern.y + pattern.z + pattern.w;
  float at = mod(v_extra.z, period);
  float covered = max(max(dash(at, pattern.x), dash(at - period, pattern.x)),
                      dash(at - pattern.x - pattern.y, pattern.z));
  fragment = v_color * (across * along * covered);
}
