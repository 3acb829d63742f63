#version 330 core
// A fill with 45-degree hatch lines. extra.x: distance across the lines.
in vec4 v_color;
in vec4 v_extra;
uniform vec4 line_colour; // premultiplied
uniform vec2 line;        // pitch, half width in device pixels
out vec4 fragment;

void main() {
  float across = abs(mod(v_extra.x + 0.5 * line.x, line.x) - 0.5 * line.x);
  // A line thinner than a pixel covers its width's share.
  float covered = clamp(line.y + 0.5 - across, 0.0, min(1.0, 2.0 * line.y));
  fragment = mix(v_color, line_colour, covered * line_colour.a);
}
