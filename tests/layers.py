#!/usr/bin/python3
"""The layers hold: engine knows nothing of GLib, GL, files or printing; app nothing of GTK; inside
a layer, a room includes only rooms below it.

layers.py SOURCE ENGINE.a APP.a SEALBENCH LIBRARY.so, TAP on standard output.
"""
import glob
import os
import re
import subprocess
import sys
import tempfile


def symbols(library, kinds):
    out = subprocess.run(['nm', library], capture_output=True, text=True, check=True).stdout
    return {line.split()[-1] for line in out.splitlines()
            if len(line.split()) >= 2 and line.split()[-2] in kinds}


def matching(names, pattern):
    return sorted(name for name in names if re.match(pattern, name))


# Rooms from below; those of one line know nothing of each other.
ROOMS = {
    'engine': ['base', 'numeric', 'contact', 'film permeation', 'rubber mechanism fluid', 'valve'],
    'app': ['base lazy', 'cad draw table', 'document', 'data', 'chart run study', 'library section', 'session', 'export', 'terminal', 'cli', 'mpi'],
    'ui': ['views', 'params', 'window'],
}


# Rooms of the valve, from the left: each includes only rooms to its left.
VALVE_ROOMS = ['model', 'figures', 'states', 'shelf', 'run', 'answer', 'studies']


def sources_below(folder):
    for path in sorted(glob.glob(f'{folder}/**/*', recursive=True)):
        if path.endswith(('.c', '.h', '.def')):
            with open(path, encoding='utf-8') as file:
                yield path, file.read()


def arrows_up(source):
    """Includes of a layer or a room that is not below the including file's own."""
    found = []
    layers = list(ROOMS)
    for layer, floors in ROOMS.items():
        floor = {room: number for number, rooms in enumerate(floors) for room in rooms.split()}
        for path, text in sources_below(f'{source}/{layer}'):
            name = os.path.relpath(path, source)
            room = name.split('/')[1]
            for where, other in re.findall(r'#include "(engine|app|ui)/(\w+)/', text):
                if layers.index(where) > layers.index(layer) or (
                        where == layer and other != room and floor[other] >= floor[room]):
                    found.append(f'{name} -> {where}/{other}')
    return found


def arrows_right(source):
    """Includes of the valve's rooms that do not go to the left, and of another room's private header."""
    found = []
    for path, text in sources_below(f'{source}/engine/valve'):
        room = os.path.relpath(path, f'{source}/engine/valve').split('/')[0]
        if room not in VALVE_ROOMS:
            continue  # sealbench.h includes all
        for other, header in re.findall(r'#include "engine/valve/(\w+)/?([^"]*)"', text):
            if other != room and (other not in VALVE_ROOMS or header.endswith('_private.h') or
                                  VALVE_ROOMS.index(other) > VALVE_ROOMS.index(room)):
                found.append(f'{os.path.relpath(path, source)} -> {other}/{header}')
    return found


def lines_of_rooms_that_pass():
    """Wrong lines that arrows_right() does not find: it reads a source tree with one line in each room."""
    wrong = {'model': 'states/sliding.h', 'figures': 'run/run.h', 'states': 'shelf/shelf.h',
             'shelf': 'run/plan.h', 'run': 'shelf/shelf_private.h', 'answer': 'studies/study.h',
             'studies': 'sealbench.h'}
    with tempfile.TemporaryDirectory() as source:
        for room in VALVE_ROOMS:
            os.makedirs(f'{source}/engine/valve/{room}')
            with open(f'{source}/engine/valve/{room}/file.c', 'w', encoding='utf-8') as file:
                file.write(f'#include "engine/valve/{room}/own_private.h"\n'
                           '#include "engine/valve/model/params.h"\n'
                           f'#include "engine/valve/{wrong[room]}"\n')
        found = arrows_right(source)
    return [line for room, line in wrong.items()
            if sum(name.startswith(f'engine/valve/{room}/') for name in found) != 1]


def keys_that_pass():
    """Keys in a file of a room below the valve that keys_below() does not find."""
    wrong = ['"gland.radial_space"', '"see models.fit = ring"', '"seal.outer.modulus"']
    with tempfile.TemporaryDirectory() as source:
        os.makedirs(f'{source}/engine/film')
        with open(f'{source}/engine/film/film.c', 'w', encoding='utf-8') as file:
            file.write('#include "engine/film/film.h" // models.film\n' + '\n'.join(wrong) + '\n"the seal. A ring"\n')
        found = keys_below(source, {'gland.radial_space', 'models.fit', 'seal.outer.modulus'})
    return [] if len(found) == len(wrong) else found or ['none']


def readers_of_the_model(source):
    """Files that see, by whatever includes, what a model is made of, and are neither of engine/valve
    nor tests of the engine: to everybody else it is opaque, so that nobody can change one."""
    includes = {}
    for path in glob.glob(f'{source}/*/**/*.[ch]', recursive=True):
        name = os.path.relpath(path, source)
        if name.split('/')[0] in ROOMS or name.startswith('tests/'):
            with open(path, encoding='utf-8') as file:
                includes[name] = re.findall(r'#include "([^"]+)"', file.read())

    def sees(name, seen):
        return name == 'engine/valve/model/model.h' or any(
            other not in seen and sees(other, seen | {other}) for other in includes.get(name, []))

    return [name for name in sorted(includes)
            if not name.startswith(('engine/valve/', 'tests/engine/')) and sees(name, {name})]


source, engine, app, program, library = sys.argv[1:]
libraries = subprocess.run(['ldd', program], capture_output=True, text=True, check=True).stdout


def lost_rooms(source):
    """Places that the help of parameters names and that are not there."""
    with open(source + '/engine/valve/model/param_equation.c', encoding='utf-8') as text:
        rooms = re.findall(r'"(engine/[^"]*|docs/[^"]*)"', text.read())
    return [room for room in rooms if not os.path.exists(f'{source}/{room}')]


def sources_of_the_loop(source):
    """Places in ui/ that add a source to the main loop but by views/later.c, whose calls end with their
    widget. latency.c watches the loop itself, as long as the program runs."""
    allowed = ('ui/views/later.c', 'ui/window/latency.c')
    return [os.path.relpath(path, source) for path in sorted(glob.glob(f'{source}/ui/**/*.c', recursive=True))
            if os.path.relpath(path, source) not in allowed and
            re.search(r'\b(g_idle_add|g_timeout_add|g_source_attach|gdk_threads_add|g_unix_fd_add|g_child_watch_add)',
                      open(path, encoding='utf-8').read())]


# A choice of params.def that code compares.
CHOICE = re.compile(r'([!=<>]=|[<>]|\bcase) *SB_(FIT|FILM)_(KARASZKIEWICZ|HERTZ|LINDLEY|GREEN_ENGLISH|DISC|DISC_THESIS|RING|'
                    r'THESIS|ASYMPTOTIC|REYNOLDS|INVERSE|MOES|RIGID)\b')
# Choices of the valve's kind, asperities and motion, also through a predicate.
KIND = re.compile(r'([!=]=|\bcase) *SB_(VALVE_(PISTON|GASKET)|MODEL_(ASPERITIES|MOTION)_\w+)\b|'
                  r'\bsb_model_is_(rig|gasket)\(')
KINDS = ['if (model->kind == SB_VALVE_GASKET) {', 'case SB_MODEL_ASPERITIES_COUPLED:',
         'model->asperities != SB_MODEL_ASPERITIES_BESIDE ||', 'const bool gasket = sb_model_is_gasket(model);',
         'if (model->motion == SB_MODEL_MOTION_RIG) {']
# Models of the rough surface.
SURFACE = re.compile(r'([!=]=|\bcase) *SB_ROUGH_(GREENWOOD_TRIPP|PERSSON)\b')
SURFACES = ['if (model->surface == SB_ROUGH_PERSSON) {', 'problem->surface != SB_ROUGH_GREENWOOD_TRIPP &&']
CHOICES = ['if (model->fit == SB_FIT_RING) {', '  case SB_FILM_MOES:', 'fit < SB_FIT_DISC_THESIS && solved',
           'film->model != SB_FILM_REYNOLDS ||', 'cost(model->fit == SB_FIT_RING, model)']
# Comparisons of a figure's columns, also with a variable (decisions.py: with a literal, in all layers).
FIGURE_TEXT = re.compile(r'\bstr(?:n?cmp|str|n?casecmp)\([^;]*(?:->|\b)(?:path|si|shown|where)\b')


def catalogue_keys(source):
    """All keys of params.def."""
    with open(f'{source}/engine/valve/model/params.def', encoding='utf-8') as file:
        rows = re.findall(r'^SB_(REAL|SEAL|INT|CHOICE|FLAGS)\s*\(.*?"([^"]+)"', file.read(), re.M)
    return {key for kind, name in rows for key in (
        [f'seal.{name}', f'seal.outer.{name}', f'seal.inner.{name}'] if kind == 'SEAL' else [name])}


def keys_below(source, keys):
    """String literals of the rooms below the valve that have a key of the catalogue, or of a group of it."""
    groups = '|'.join(sorted({key.split('.')[0] for key in keys}))
    key = re.compile(rf'(?<![\w./])(?:{groups})\.[a-z_]+(?![\w/(]|\.[ch])')
    return [f'{os.path.relpath(path, source)}: {literal}' for path, text in sources_below(f'{source}/engine')
            if os.path.relpath(path, source).split('/')[1] != 'valve'
            for literal in re.findall(r'"((?:[^"\\\n]|\\.)*)"', re.sub(r'//.*|#include.*', '', text))
            if key.search(literal)]


def lines_with(source, folders, pattern, allowed=()):
    """Places of lines in C files that match a pattern."""
    return [f'{os.path.relpath(path, source)}: {line.strip()}'
            for folder in folders for path, text in sources_below(f'{source}/{folder}')
            if os.path.relpath(path, source) not in allowed
            for line in text.split('\n') if pattern.search(line)]


def visible(path):
    """What a shared library lets others see, but for the linker's own marks."""
    out = subprocess.run(['nm', '-D', '--defined-only', path], capture_output=True, text=True, check=True)
    return {line.split()[-1] for line in out.stdout.splitlines() if line.split()[-2] != 'A'}


with open(source + '/include/sealbench.h', encoding='utf-8') as file:
    declared = set(re.findall(r'\b(sb_\w+)\(', re.sub(r'//.*', '', file.read())))
needed = re.findall(r'\(NEEDED\).*\[(\S+)\]', subprocess.run(
    ['readelf', '-d', library], capture_output=True, text=True, check=True).stdout)
LIBRARY_MAY_NEED = r'lib(openblas|lapacke|gsl|gslcblas|amd|suitesparseconfig|m|c|pthread|glib-2\.0|gio-2\.0|gobject-2\.0|udunits2)\.so'
checks = [
    ('engine uses no GLib, GTK, cairo, pango, GL, libav or udunits',
     matching(symbols(engine, 'U'), r'(g|gtk|gdk|cairo|pango|av|ut|cv)_|gl[A-Z]|egl[A-Z]|OSMesa')),
    ('engine does not print, open files, exit or ask for the locale',
     matching(symbols(engine, 'U'),
              r'(v?f?printf|f?puts|putchar|perror|f?open|exit|_exit|abort|setlocale|getenv)(64|_chk)?$')),
    ('engine has no writable globals',
     [name for name in sorted(symbols(engine, 'bBC')) if not name.startswith(('__', '.'))]),
    ('app uses no GTK', matching(symbols(app, 'U'), r'(gtk|gdk)_')),
    ('no layer includes one above it, no room one beside or above it', arrows_up(source)),
    ('no room of the valve includes one to its right, or a private header of another', arrows_right(source)),
    ('each wrong include of a room of the valve is found', lines_of_rooms_that_pass()),
    ('no code of the valve decides by the text of a figure\'s path or unit',
     lines_with(source, [f'engine/valve/{room}' for room in VALVE_ROOMS[1:]], FIGURE_TEXT,
                ['engine/valve/figures/figures.c'])),
    ('that test finds such a line', [] if FIGURE_TEXT.search('if (strncmp(figure->path, "solver.", 7) == 0) {')
     and FIGURE_TEXT.search('strcmp(row->si, "J") == 0') else ['it does not']),
    ('no code outside their rooms compares a choice of fit or film (sb_fit_kind(), sb_film_kind())',
     lines_with(source, ['engine/fluid', 'engine/mechanism', 'engine/rubber', 'engine/valve', 'app', 'ui'], CHOICE)),
    ('that test finds such a line', [line for line in CHOICES if not CHOICE.search(line)]),
    ('no code of the engine outside engine/valve/model compares the kind of valve, its asperities or its '
     'motion (sb_valve_type(), sb_contact_law(), sb_motion_kind())',
     lines_with(source, [f'engine/valve/{room}' for room in VALVE_ROOMS[1:]], KIND)),
    ('no code of app and ui compares them (sb_device())', lines_with(source, ['app', 'ui'], KIND)),
    ('that test finds such a line', [line for line in KINDS if not KIND.search(line)]),
    ('no code outside engine/contact/rough compares the model of a rough surface (sb_rough_kind())',
     lines_with(source, ['engine/film', 'engine/contact/disc', 'engine/contact/ring', 'engine/valve', 'app', 'ui'],
                SURFACE)),
    ('that test finds such a line', [line for line in SURFACES if not SURFACE.search(line)]),
    ('no room below the valve names a key of the catalogue', keys_below(source, catalogue_keys(source))),
    ('that test finds such a key', keys_that_pass()),
    ('the result of every copy of a model is used',
     lines_with(source, ['engine', 'app', 'ui'], re.compile(r'\(void\) ?sb_model_copy\('))),
    ('the library shows what its header declares and nothing else', sorted(visible(library) ^ declared)),
    ('the library needs GLib, GIO, udunits and the engine\'s libraries alone',
     [name for name in needed if not re.match(LIBRARY_MAY_NEED, name)]),
    ('no file outside engine/valve sees what a model is made of', readers_of_the_model(source)),
    ('the help of parameters names places that are there', lost_rooms(source)),
    ('no call of the main loop in ui outlives its widget', sources_of_the_loop(source)),
    ('sealbench is not linked with GTK', re.findall(r'lib(?:gtk|gdk)-\S+', libraries)),
]
print(f'1..{len(checks)}')
for number, (name, found) in enumerate(checks, 1):
    print(f'{"not ok" if found else "ok"} {number} {name}')
    if found:
        print('#', ' '.join(found[:20]))
sys.exit(any(found for _, found in checks))
