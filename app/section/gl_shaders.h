// Texts of the files in shaders/, embedded by the build.
#pragma once

extern const char sb_shader_section_vert[];
extern const char sb_shader_flat_frag[];
extern const char sb_shader_dash_frag[];
extern const char sb_shader_hatch_frag[];
extern const char sb_shader_field_frag[];
extern const char sb_shader_text_frag[];
