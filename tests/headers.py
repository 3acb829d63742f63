#!/usr/bin/python3
"""Every header compiles alone, twice, by the flags of its layer, and so does a variable of each type
that it gives an initialiser for (SbRingLoad, SB_RING_LOAD_INIT); a dropped status does not pass.
The build itself has compiled a header that comes first in its own source; it needs a guard alone.

headers.py BUILD SOURCE LAYER..., TAP on standard output.
"""
import concurrent.futures
import json
import os
import re
import shlex
import shutil
import subprocess
import sys

build, source, *layers = sys.argv[1:]
# The installed header stands alone as C and as C++, with no flags at all.

# How a layer is compiled: compiler, places of headers and definitions of the file that has most of
# them: some files use fewer libraries than their layer.
commands = {}
with open(build + '/compile_commands.json', encoding='utf-8') as database:
    for entry in json.load(database):
        words = shlex.split(entry['command'])
        path = os.path.relpath(os.path.join(entry['directory'], entry['file']), source)
        layer = path.split(os.sep)[0]
        if layer in layers:
            first = next(i for i, word in enumerate(words) if word.startswith('-'))
            command = words[:first] + [
                word for word in words if word.startswith(('-I', '-isystem', '-D', '-std', '-pthread'))]
            commands[layer] = max(commands.get(layer, []), command, key=len)
            folder = entry['directory']


def compiles(layer, text, *options):
    """What the compiler says, empty if nothing."""
    return subprocess.run(
        [*commands[layer], '-Wall', '-Wextra', '-Wno-unused-parameter', '-Wpedantic', '-Werror',
         *options, '-fsyntax-only', '-x', 'c', '-'],
        input=text, capture_output=True, text=True, cwd=folder, check=False).stderr


def first_in_source(header):
    """Whether the header's own source begins with it."""
    try:
        with open(os.path.join(source, header[:-2] + '.c'), encoding='utf-8') as file:
            includes = re.search(r'^#include ["<](.*)[">]', file.read(), re.M)
    except FileNotFoundError:
        return False
    return includes is not None and includes[1] == header


def alone(header):
    layer = header.split(os.sep)[0]
    # GObject's macros do not pass -Wpedantic.
    options = ['-Wno-pedantic'] if layer == 'ui' else []
    with open(os.path.join(source, header), encoding='utf-8') as file:
        text = file.read()
    names = re.findall(r'^#define SB_(\w+)_INIT\b', text, re.M)
    if not names and first_in_source(header):
        return '' if re.search('^#(pragma once|ifndef SB_)', text, re.M) else 'no guard'
    used = ''.join(f'Sb{name.title().replace("_", "")} v{name} = SB_{name}_INIT;\n' for name in names)
    return compiles(layer, f'#include "{header}"\n#include "{header}"\nint used;\n{used}', *options)


headers = sorted(os.path.relpath(os.path.join(where, name), source)
                 for layer in commands for where, _, names in os.walk(os.path.join(source, layer))
                 for name in names if name.endswith('.h'))
with concurrent.futures.ThreadPoolExecutor(2) as pool:
    results = [(header + ' stands alone', said == '', said)
               for header, said in zip(headers, pool.map(alone, headers))]

for language in ('c', 'c++') if shutil.which('c++') else ('c',):
    said = subprocess.run(['c++' if language == 'c++' else 'cc', '-x', language, '-I', source + '/include',
                           '-Wall', '-Wextra', '-Wpedantic', '-Werror', '-fsyntax-only', '-'],
                          input='#include <sealbench.h>\n#include <sealbench.h>\nSbScene *used;\n',
                          capture_output=True, text=True, check=False).stderr
    results.append((f'include/sealbench.h stands alone as {language}', said == '', said))

DROPS = '#include "engine/base/status.h"\nSbStatus f(void);\nvoid g(void);\nvoid g(void) {\n  %s;\n}\n'
if 'engine' in layers:
    said = compiles('engine', DROPS % 'f()')
    results.append(('a dropped status is refused', 'unused-result' in said, said))
    said = compiles('engine', DROPS % '(void)f()')
    results.append(('a status dropped on purpose is not', said == '', said))

print(f'1..{len(results)}')
for number, (text, good, said) in enumerate(results, 1):
    print(f'{"ok" if good else "not ok"} {number} {text}')
    if not good:
        print('\n'.join('# ' + line for line in said.splitlines()[:8]))
sys.exit(not all(good for _, good, _ in results))
