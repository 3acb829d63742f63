#version 330 core
// One vertex format for all programs. Positions are device pixels, y down; `flip` is +1 for an own
// framebuffer whose rows are read top down, -1 for a window's.
layout(location = 0) in vec2 position;
layout(location = 1) in vec4 color; // premultiplied
layout(location = 2) in vec4 extra;  // meaning: see the fragment shaders
uniform vec2 to_clip; // 2 / width, 2 / height
uniform float flip;
out vec4 v_color;
out vec4 v_extra;

void main() {
  vec2 clip = position * to_clip - 1.0;
  gl_Position = vec4(clip.x, clip.y * flip, 0.0, 1.0);
  v_color = color;
  v_extra = extra;
}
