// GLSL sources of the files shaders/*.vert and shaders/*.frag, embedded by the build. Each array
// ends with 0; sb_shader_NAME_frag is shaders/NAME.frag.
#pragma once

extern const char sb_shader_section_vert[]; // vertex shader of all programs
extern const char sb_shader_flat_frag[];    // fills and solid lines
extern const char sb_shader_dash_frag[];    // dashed lines
extern const char sb_shader_hatch_frag[];   // hatched fills
extern const char sb_shader_field_frag[];   // meshes with a colour map
extern const char sb_shader_text_frag[];    // text from the atlas
