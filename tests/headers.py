#!/usr/bin/python3
"""Every header compiles alone, twice, by the flags of its layer, and so does a variable of each type
that it gives an initialiser for (SbRingLoad, SB_RING_LOAD_INIT); a dropped status does not pass.
Each function, and each type of functions, has a comment of its own on the line above its declaration.
No comment or declaration is broken where a formatter met a line that was too long.
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
# Folders whose headers must have a comment for each function.
COMMENTED = ('engine', 'include', 'app', 'ui')
# The installed header stands alone as C and as C++, with no flags at all.

# How a layer is compiled: compiler, places of headers and definitions of the file that has most of
# them: some files use fewer libraries than their layer.
commands = {}
with open(build + '/compile_commands.json', encoding='utf-8') as database:
    for entry in json.load(database):
        words = shlex.split(entry['command'])
        # The target's folder: a file that is compiled may stand for a folder of the layer.
        layer = entry['output'].split('/')[0]
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


def uncommented(text):
    """(line, name) of each function, and of each pointer type of functions, that is declared without a
    comment on the line directly above."""
    found, depth, first, above = [], 0, None, ''
    text = re.sub(r'^#(?:.*\\\n)*.*$', lambda macro: '#' + '\n#' * macro.group().count('\n'), text, flags=re.M)
    for number, line in enumerate(text.replace('extern "C" {', '').split('\n'), 1):
        code = line.split('//')[0].rstrip()
        if depth == 0 and first is None and re.match('[A-Za-z]', code):
            first, signature, comment = number, '', above.startswith('//')
        if depth == 0 and first is not None:
            signature += code.split('{')[0] + ' '
        depth = max(0, depth + code.count('{') - code.count('}'))
        if first is not None and depth == 0 and (
                code.endswith((';', '}')) or re.match(r'[A-Z_]+\(.*\) $', signature)):
            name = re.search(r'\(\*(\w+)\)\(' if signature.startswith('typedef') else r'\b([a-z]\w*)\(',
                             signature)
            if name and name[1] != 'static_assert' and code.endswith((';', '}')) and not comment:
                found.append((first, name[1]))
            first = None
        above = line
    return found


# A comment's line that ends early although the first word of the next one has room, and a declaration
# whose name is alone on the next line: what clang-format leaves of a line of more than 100 columns.
RAGGED = re.compile(r'^// (?! ).{0,76}[^.:;\n]\n// (?=[a-z(`*+-]\S{0,11}(?:\s|$))', re.M)
BROKEN = re.compile(r'^ +(?:const )?\w+(?: \w+,)?\n {6,}\*?\w+;', re.M)


def damaged(text):
    """Numbers of the lines that a formatter broke."""
    return sorted(text.count('\n', 0, match.start()) + 1
                  for pattern in (RAGGED, BROKEN) for match in pattern.finditer(text))


# The searches themselves: what they must find, and a header in which they must find nothing.
BARE = [('void f(void);', 'f'), ('// One.\nvoid f(void);\nvoid g(void);', 'g'), ('// One.\n\nint f(int a,\n      int b);', 'f'),
        ('int f(void) { // not its own\n  return 0;\n}', 'f'), ('typedef double (*F)(double x);', 'F'),
        ('// One.\nvoid f(void); // one\nvoid g(void);', 'g'), ('G_DECLARE_TYPE(A, a, B,\n  C)\nvoid f(void);', 'f'),
        ('#define M(a) \\\n  a\nvoid f(void) SB_PRINTF(1, 2);', 'f'), ('extern "C" {\nvoid f(void);\n}', 'f')]
FULL = ('// One.\ntypedef struct {\n  int (*call)(int a);\n} A;\n\n#define M(x) f(x)\n// Two.\nint f(int a,\n      int b);\n'
        'enum { B = sizeof(A) };\ntypedef struct C C;\nextern const int d[3];\nG_DECLARE_TYPE(A, a)\n// Three.\n'
        'static inline int g(void) {\n  return f(1, 2);\n}\nstatic_assert(1, "one");\n')

DAMAGED = [('// Draws a chart with\n// the axes.\n', [1]), ('// One: a\n// b.\n// Two.\n//   list\n', [1]),
           ('// One.\n// two\n', []), ('// A list:\n// a\n', []),
           ('struct {\n  SbVerdict\n      of; // the answer\n};\n', [2]),
           ('struct {\n  size_t first,\n      count; // bytes\n};\n', [2]), ('enum {\n  A,\n  B\n};\n', [])]

headers = sorted(os.path.relpath(os.path.join(where, name), source)
                 for layer in commands for where, _, names in os.walk(os.path.join(source, layer))
                 for name in names if name.endswith('.h'))
with concurrent.futures.ThreadPoolExecutor(2) as pool:
    results = [(header + ' stands alone', said == '', said)
               for header, said in zip(headers, pool.map(alone, headers))]

said = [f'{text!r}: {found}' for text, name in BARE + [(FULL, '')]
        for found in [[name for _, name in uncommented(text)]] if found != [name] * (name != '')]
results.append(('functions without a comment are found', not said, '\n'.join(said)))
said = [repr(text) for text, lines in DAMAGED + [(FULL, [])] if damaged(text) != lines]
results.append(('broken lines are found', not said, '\n'.join(said)))
for header in headers + ['include/sealbench.h']:
    if header.startswith(COMMENTED):
        with open(os.path.join(source, header), encoding='utf-8') as file:
            text = file.read()
        bare, lines = uncommented(text), damaged(text)
        results.append((f'{header} has no broken lines', not lines,
                        '\n'.join(f'{header}:{line}: is broken after it' for line in lines)))
        results.append((f'{header} has a comment for each function', not bare,
                        '\n'.join(f'{header}:{line}: {name}() needs a comment of its own' for line, name in bare)))

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
