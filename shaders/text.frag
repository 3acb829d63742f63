#version 330 core
// Glyphs: coverage from the atlas. extra.xy: texel.
in vec4 v_color;
in vec4 v_extra;
uniform sampler2D atlas;
out vec4 fragment;

void main() {
  fragment = v_color * texelFetch(atlas, ivec2(v_extra.xy), 0).r;
}
