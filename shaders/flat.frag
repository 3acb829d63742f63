#version 330 core
// Fills and solid lines. extra: distance across the line, half its width, distance along it, its
// length; a fill has half width 1e6 and its soft edge in the colour.
in vec4 v_color;
in vec4 v_extra;
out vec4 fragment;

void main() {
  float across = clamp(v_extra.y + 0.5 - abs(v_extra.x), 0.0, 1.0);
  float along = clamp(min(v_extra.z, v_extra.w - v_extra.z) + 0.5, 0.0, 1.0);
  fragment = v_color * (across * along);
}
