#!/usr/bin/python3
"""Functions of more than one screen: at most 20 of more than 60 lines in engine, app and ui, each with the
reason for which it is not divided.

sizes.py SOURCE, TAP on standard output.
"""
import glob
import os
import re
import sys

LINES, FUNCTIONS = 60, 20
NEWTON = 'one loop of Newton: its steps share the residuals, the damping and the counters of the iteration'
PATH = 'one loop along a path: its cases of a rejected step share step length, state and budget'
RESULT = 'fills one result: a line or a short block for each member'
# function: why it is not divided.
REASONS = {
}
BEGIN = re.compile(r'^(?!typedef|struct|enum|union|static const|#)[A-Za-z_][^;=]*?\b(\w+)\(')


def functions(text):
    """(name, lines) of each function of a formatted source file."""
    name, begin = None, 0
    for number, line in enumerate(text.split('\n')):
        match = BEGIN.match(line)
        if match and name is None:
            name, begin = match.group(1), number
        if name is not None and line.endswith(';') and not line.startswith((' ', '}')):
            name = None  # a declaration of one line
        if line.startswith('}') and name is not None:
            yield name, number - begin + 1
            name = None
        elif name is not None and line == '':
            name = name if any(part.endswith('{') for part in text.split('\n')[begin:number]) else None


source = sys.argv[1]
found = {}
for path in sorted(path for layer in ('engine', 'app', 'ui') for path in glob.glob(f'{source}/{layer}/**/*.[ch]', recursive=True)):
    with open(path, encoding='utf-8') as file:
        for name, lines in functions(file.read()):
            if lines > LINES:
                found[name] = f'{lines} {name} in {os.path.relpath(path, source)}'
if '--list' in sys.argv:
    print('\n'.join(sorted(found.values(), reverse=True)))
