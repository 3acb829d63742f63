#version 330 core
// A scalar through a colour map of 256 entries. extra.x: the scalar, 0 to 1 over the map.
in vec4 v_colour;
in vec4 v_extra;
uniform sampler2D map;
out vec4 fragment;

void main() {
  float t = clamp(v_extra.x, 0.0, 1.0);
  fragment = vec4(texture(map, vec2((t * 255.0 + 0.5) / 256.0, 0.5)).rgb, 1.0);
}
