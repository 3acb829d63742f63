#version 330 core
// A scalar through a colour map of 256 entries. extra.x: the scalar, 0 to 1 over the map.
in vec4 v_color;
in vec4 v_extra;
uniform sampler2D map;
uniform float levels;      // 0: no lines of equal value
uniform vec4 line_colour;  // straight
uniform vec2 line;         // unused, half width in device pixels
out vec4 fragment;

void main() {
  float t = clamp(v_extra.x, 0.0, 1.0);
  fragment = vec4(texture(map, vec2((t * 255.0 + 0.5) / 256.0, 0.5)).rgb, 1.0);
  float level = v_extra.x * levels;
  float slope = fwidth(level);
  if (levels > 0.0 && slope > 1e-6) {
    float away = abs(fract(level - 0.5) - 0.5) / slope;
    // Where lines would be denser than three pixels they would only darken.
    float covered = clamp(line.y + 0.5 - away, 0.0, 1.0) * clamp(2.0 - 6.0 * slope, 0.0, 1.0);
    fragment = mix(fragment, line_colour, min(covered, 2.0 * line.y) * line_colour.a);
  }
}
