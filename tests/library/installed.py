#!/usr/bin/python3
"""The library as others have it: installed somewhere, found by pkg-config, with a program of 30 lines
and a script of 10 built outside the tree; both fit a ring, run the thesis' cycle and say the same as
the command line.

installed.py BUILD SOURCE COMPILER [python], TAP on standard output.
"""
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile

build, source, compiler, *rest = sys.argv[1:]
here = source + '/tests/library'
results = []


def check(name, good, said=''):
    results.append(good)
    print(f'{"ok" if good else "not ok"} {len(results)} {name}')
    if not good:
        print('\n'.join('# ' + line for line in str(said).splitlines()[:12]))


def run(*command, **more):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **more)
    return done.returncode, done.stdout, done.stderr


def lines_of_code(path):
    with open(path, encoding='utf-8') as file:
        return len(file.read().splitlines())


with tempfile.TemporaryDirectory(prefix='sealbench-installed-') as root:
    code, _, said = run('meson', 'install', '-C', build, '--no-rebuild', '--destdir', root,
                        '--tags', 'runtime,devel,python-runtime')
    check('meson install --destdir', code == 0, said)
    places = {name: where for where, _, names in os.walk(root) for name in names}
    places.update({name: where for where, _, names in os.walk(root) for name in names
                   if name.startswith('libsealbench')})
    missing = [name for name in ('sealbench.h', 'sealbench.pc', 'libsealbench.so.0') if name not in places]
    check('header, sealbench.pc and library are there', not missing, missing)
    env = {**os.environ, 'PKG_CONFIG_PATH': places['sealbench.pc'], 'PKG_CONFIG_SYSROOT_DIR': root,
           'LD_LIBRARY_PATH': places['libsealbench.so.0'], 'OPENBLAS_NUM_THREADS': '1'}
    _, flags, _ = run('pkg-config', '--cflags', '--libs', 'sealbench', env=env)
    scene = source + '/assets/scenes/thesis-cycle.scene'

    # As C and, where there is a compiler, as C++, from another folder.
    program = root + '/fit_and_cycle'
    for language, command in (('C', compiler), ('C++', 'c++')):
        if language == 'C++' and run('sh', '-c', 'command -v c++')[0] != 0:
            continue
        code, _, said = run(command, '-x', language.lower(), here + '/fit_and_cycle.c', '-x', 'none', '-o',
                            program if language == 'C' else program + '++', '-Wall', '-Wextra', '-Werror',
                            *shlex.split(flags), cwd=root, env=env)
        check(f'a program in {language} builds by pkg-config', code == 0, said)
    code, by_c, said = run(program, scene, cwd=root, env=env)
    check('it runs', code == 0, said)
    check('it has 30 lines', lines_of_code(here + '/fit_and_cycle.c') <= 30)

    # The command line says the same.
    got = [float(x) for x in re.findall(r'[-+.e\d]{8,}', by_c)]
    _, text, said = run(build + '/sealbench', 'run', scene, '--quiet', '--json', '-', env=env)
    ours = json.loads(text)
    _, text, said = run(build + '/sealbench', 'run', scene, '--quiet', '--json', '-', '--set',
                        'models.fit=ring', env=env)
    ring = json.loads(text)
    outer = ours['seals']['outer']
    wanted = [ring['seals']['outer']['load_N'], ours['cycle']['stages']['B']['force_N']]
    check('the ring and B are those of the command line', len(got) == 3 and got[:2] == wanted, (got, wanted))
    # The profile is the film's own: its peak lies within some per cent of the dry contact's.
    check("the profile's peak is the outer seal's",
          len(got) == 3 and abs(got[2] / outer['pressure_peak_Pa'] - 1) < 0.1, (got, outer['pressure_peak_Pa']))

    code, _, said = run(program, root + '/missing.scene', cwd=root, env=env)
    check('a file that is not there is told', code == 1 and 'missing.scene: No such file' in said, said)

    if rest and rest[0]:
        where = places.get('sealbench.py', '')
        check('the module is installed', where != '', sorted(places))
        # Found beside the module; no variable says where.
        bare = {name: value for name, value in env.items() if name not in ('LD_LIBRARY_PATH', 'SEALBENCH_LIBRARY')}
        code, by_python, said = run('/usr/bin/python3', here + '/fit_and_cycle.py', scene, cwd=root,
                                    env={**bare, 'PYTHONPATH': where})
        check('a script says the same', code == 0 and by_python == by_c, said or by_python)
        check('it has 10 lines', lines_of_code(here + '/fit_and_cycle.py') <= 10)
        code, _, said = run('/usr/bin/python3', os.path.join(places['sweep_squeeze.py'], 'sweep_squeeze.py'),
                            '-o', root + '/sweep.csv', '--points', '3', cwd=root, env={**bare, 'PYTHONPATH': where})
        check('the example sweeps', code == 0 and lines_of_code(root + '/sweep.csv') == 4, said)

print(f'1..{len(results)}')
sys.exit(not all(results))
