# Writes a C file with the text of each shader as sb_shader_NAME: embed.py OUT IN...
import os
import sys

with open(sys.argv[1], 'w') as out:
    out.write('#include "app/section/gl_shaders.h"\n')
    for path in sys.argv[2:]:
        name = os.path.basename(path).replace('.', '_')
        data = open(path, 'rb').read() + b'\0'
        out.write(f'const char sb_shader_{name}[] = {{{",".join(str(b) for b in data)}}};\n')
