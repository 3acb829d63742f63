#!/usr/bin/python3
"""The layers hold: engine knows nothing of GLib, GL, files or printing; app nothing of GTK.

layers.py ENGINE.a APP.a SEALBENCH, TAP on standard output.
"""
import re
import subprocess
import sys


def symbols(library, kinds):
    out = subprocess.run(['nm', library], capture_output=True, text=True, check=True).stdout
    return {line.split()[-1] for line in out.splitlines()
            if len(line.split()) >= 2 and line.split()[-2] in kinds}


def matching(names, pattern):
    return sorted(name for name in names if re.match(pattern, name))


engine, app, program = sys.argv[1:]
libraries = subprocess.run(['ldd', program], capture_output=True, text=True, check=True).stdout
checks = [
    ('engine uses no GLib, GTK, cairo, pango, GL, libav or udunits',
     matching(symbols(engine, 'U'), r'(g|gtk|gdk|cairo|pango|av|ut|cv)_|gl[A-Z]|egl[A-Z]|OSMesa')),
    ('engine does not print, open files, exit or ask for the locale',
     matching(symbols(engine, 'U'),
              r'(v?f?printf|f?puts|putchar|perror|f?open|exit|_exit|abort|setlocale|getenv)(64|_chk)?$')),
    ('engine has no writable globals',
     [name for name in sorted(symbols(engine, 'bBC')) if not name.startswith(('__', '.'))]),
    ('app uses no GTK', matching(symbols(app, 'U'), r'(gtk|gdk)_')),
    ('sealbench is not linked with GTK', re.findall(r'lib(?:gtk|gdk)-\S+', libraries)),
]
print(f'1..{len(checks)}')
for number, (name, found) in enumerate(checks, 1):
    print(f'{"not ok" if found else "ok"} {number} {name}')
    if found:
        print('#', ' '.join(found[:20]))
sys.exit(any(found for _, found in checks))
