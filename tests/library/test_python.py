#!/usr/bin/python3
"""The Python module: values and units, failures, frames, profiles, evaluation, callbacks, threads.

test_python.py SOURCE, TAP on standard output.
"""
import copy
import math
import os
import pickle
import sys
import tempfile
import threading
import typing

import sealbench

SCENES = sys.argv[1] + '/assets/scenes/'
results = []


def check(name, good, said=''):
    results.append(bool(good))
    print(f'{"ok" if good else "not ok"} {len(results)} {name}{"" if good else " # " + str(said)}')


def failure(call):
    """What a call raises, as (status, key, text)."""
    try:
        call()
    except sealbench.Error as error:
        return error.status, error.key, str(error)
    return 'ok', '', ''


check('catalogues', sealbench.PARAMETERS['gland.radial_space'].unit == 'm'
      and sealbench.PARAMETERS['models.fit'].choices[-1] == 'ring'
      and sealbench.FIGURES['seals.outer.load_N'].unit == 'N' and 'time_s' in sealbench.QUANTITIES)

scene = sealbench.Scene(SCENES + 'quick-look.scene')
scene['seal.section_diameter'] = '1.63 mm'
check('text with unit', scene['seal.section_diameter'] == 1.63e-3)
scene['seal.section_diameter'] = 1.65e-3
check('number in SI', scene.text('seal.section_diameter') == '1.65 mm')
del scene['seal.section_diameter']
check('taken back', scene['seal.section_diameter'] == 1.61e-3)

status, key, text = failure(lambda: scene.__setitem__('gland.radial_space', 1.0))
check('a range', (status, key) == ('range', 'gland.radial_space') and '0.0001 to 0.02' in text, text)
status, key, text = failure(lambda: scene.__setitem__('gland.radial_spac', 1.0))
check('an unknown key', (status, key) == ('input', 'gland.radial_spac'), text)
status, _, text = failure(lambda: scene.figure('cycle.force_peak_N'))
check('no run yet', status == 'input' and 'no run' in text and scene.frame_count == 0, text)
status, _, text = failure(lambda: sealbench.Scene('/nowhere.scene'))
check('no file', status == 'io' and '/nowhere.scene' in text, text)
status, _, text = failure(lambda: sealbench.Scene(''))
check('an empty name', 'the name of the file is empty' in text, (status, text))
status, _, text = failure(lambda: sealbench.Scene(text='[sealbench]\nformat = 1\nkind = valve\n[gland]\n'
                                                  'radial_space = 9 m\naxial_width = 9 m\n'))
check('every issue of a file', status == 'input' and len(text.splitlines()) == 2, text)

scene.run()
time, force, friction = scene.frames('time_s', 'force_N', 'seals.outer.friction_N')
check('frames', len(time) == len(force) == len(friction) == scene.frame_count > 100
      and all(a <= b for a, b in zip(time, time[1:])))
check('figures', abs(max(force) / scene.figure('cycle.force_peak_N') - 1) < 1e-9)
check('errors', scene.error('seals.outer.squeeze') == 0 and 0 <= scene.error('cycle.force_peak_N') < 0.1)
film = 'seals.outer.film_by_model.reynolds'
check('a reason', math.isnan(scene.figure(film)) and 'closed form' in scene.reason(film))
profile = scene.profile(scene.frame_count // 4)
check('a profile', len(profile.x) == len(profile.film) > 50 and profile.model != ''
      and max(profile.pressure) > 0.5e6)
status, _, text = failure(lambda: scene.profile(10**6))
check('no such frame', status == 'input', text)
try:
    import numpy
    check('arrays are numpy\'s own', isinstance(time, numpy.ndarray) and time.flags.owndata is not None
          and time.dtype == float)
except ImportError:
    check('arrays without numpy', time.typecode == 'd')

paths = ['seals.outer.load_N', 'cycle.force_breakaway_N', film]
check('no error of a figure that was not computed', math.isnan(scene.error(film)))
reasons: typing.Dict[str, str] = {}
values = scene.evaluate(paths, {}, reasons)
check('evaluate says what the run says', all(values[p] == scene.figure(p) for p in paths[:2]))
check('its reasons', list(reasons) == [film], reasons)
codes: typing.List[str] = []
scene.evaluate(paths[:1], {'gland.radial_space': 1.6e-3}, warnings=codes)
check('codes of validity of an evaluation', 'karaszkiewicz-squeeze' in codes and len(set(codes)) == len(codes), codes)
codes = []
scene.evaluate(paths[:1], warnings=codes)
check('and only its own', 'karaszkiewicz-squeeze' not in codes, codes)
check('codes of a run', len(scene.warning_codes) > 0 and 'karaszkiewicz-squeeze' not in scene.warning_codes)
check('identity', len(sealbench.SOURCE) == 64 and sealbench.VERSION == '0.2.0')
more = scene.evaluate(paths[:1], {'seal.outer.section_diameter': 1.63e-3})
check('an override', more[paths[0]] > values[paths[0]] and scene['seal.outer.section_diameter'] == 1.61e-3)
status, key, text = failure(lambda: scene.evaluate(paths, {'stem.pressure_diameter': 7e-3}))
check('a refused override', (status, key) == ('input', 'bore.diameter') and 'at least' in text, text)

with sealbench.Scene(text='[sealbench]\nformat = 1\nkind = scene\nvalve = ../valves/piston.valve\n[cases]\n'
                          'tight = gland.radial_space = 1.2 mm\n', folder=SCENES) as judged:
    check('no verdict before judge()', judged.verdict == {})
    answers = judged.judge()
    check('the worst case', answers['returns'].ok is False and answers['returns'].case == 'tight'
          and answers['returns'].value < 0 and answers['seals'].ok is True, answers)
    check('an answer without a limit', answers['leak'].ok is None and math.isnan(answers['leak'].limit), answers)
    judged.run()
    check('a run forgets the verdict', judged.verdict == {})

told = []
scene.callbacks(told.append, lambda: False)
scene.run()
check('progress', told and told[-1] == 1 and told == sorted(told), told)
scene.callbacks(None, lambda: True)
check('cancel', failure(scene.run)[0] == 'cancelled')


def stops():
    raise KeyboardInterrupt


scene.callbacks(None, stops)
try:
    scene.run()
    check('what a callback raises', False)
except KeyboardInterrupt:
    check('what a callback raises', True)
scene.callbacks()
scene.run()
scene.close()
scene.close()
try:
    scene.run()
    check('a closed scene', False)
except ValueError:
    check('a closed scene', True)


def copies():
    """Copies have the text of the scene, its edits included, and are scenes of their own."""
    with sealbench.Scene(SCENES + 'quick-look.scene') as own:
        own['seal.section_diameter'] = '1.63 mm'
        own.run()
        for other in copy.copy(own), copy.deepcopy(own), pickle.loads(pickle.dumps(own)):
            with other:
                other['gland.radial_space'] = '1.35 mm'
                other.run()
                if (other['seal.section_diameter'] != 1.63e-3 or own['gland.radial_space'] != 1.36e-3
                        or other.title != own.title):
                    return False
        with copy.copy(sealbench.Scene(text='[sealbench]\nformat = 1\nkind = scene\nvalve = piston.valve\n',
                                       folder=SCENES + '../valves')) as other:
            return other['gland.radial_space'] == 1.36e-3


check('copies', copies())


def shipped():
    """A name opens the file that ships, also in a copy; a file of that name in the folder goes first."""
    before = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            with sealbench.Scene('quick-look') as scene, copy.copy(scene) as other:
                found = scene.title == other.title == 'Quick look'
            with open('quick-look', 'w', encoding='utf-8') as file:
                file.write('[sealbench]\nformat = 1\nkind = valve\ntitle = Own\n')
            with sealbench.Scene('quick-look') as scene:
                return found and scene.title == 'Own' and failure(lambda: sealbench.Scene('quick-lok'))[0] == 'io'
        finally:
            os.chdir(before)


check('a shipped scene by its name', shipped())
with sealbench.Scene(SCENES + 'quick-look.scene') as scene:
    everything = dict(scene)
    check('a mapping of parameters', list(scene) == list(sealbench.PARAMETERS) == list(everything)
          and len(scene) == len(list(scene))
          and everything['gland.radial_space'] == 1.36e-3 and 'gland.radial_space' in scene
          and 'gland' not in scene and 3 not in scene and dict(scene.items()) == everything)
    check('one figure as a str', scene.evaluate('seals.outer.load_N')
          == scene.evaluate(iter(['seals.outer.load_N'])))
    for name, call in (('a key', lambda: scene['gland.radial_space\0x']),
                       ('a value', lambda: scene.__setitem__('gland.radial_space', '1.36 mm\0x')),
                       ('a figure', lambda: scene.evaluate('seals.outer.load_N\0x')),
                       ('a quantity', lambda: scene.frames('time_s\0x')),
                       ('a seal', lambda: scene.profile(0, 'outer\0x')),
                       ('a path', lambda: sealbench.Scene(SCENES + 'quick-look.scene\0x'))):
        status, _, text = failure(call)
        check('a NUL in ' + name, status == 'input' and 'NUL' in text, text)
    for name, call in (('a value', lambda value: scene.__setitem__('gland.radial_space', value)),
                       ('an override', lambda value: scene.evaluate('seals.outer.load_N',
                                                                    {'gland.radial_space': value}))):
        for value in (None, b'1', [1.36e-3]):
            try:
                call(value)
                check(f'{name} that is no number', False, repr(value))
            except TypeError as error:
                check(f'{name} that is no number', 'gland.radial_space' in str(error), error)
    try:
        scene[3]
        check('a key that is no text', False)
    except TypeError:
        check('a key that is no text', True)


def hammer(shared, errors):
    try:
        for i in range(15):
            shared['gland.radial_space'] = 1.33e-3 + 1e-6 * i
            shared.run()
            shared.frames('time_s', 'force_N')
            shared.figures()
            shared.text('gland.radial_space')
            shared.evaluate('seals.outer.load_N', {'seal.modulus': 2.5e6})
    except Exception as error:  # pylint: disable=broad-except
        errors.append(error)


with sealbench.Scene(SCENES + 'quick-look.scene') as scene:
    scene['output.frames'] = 100
    wrong: list = []
    threads = [threading.Thread(target=hammer, args=(scene, wrong)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    check('one scene in four threads', not wrong, wrong)
    scene.callbacks(lambda fraction: scene.run())
    try:
        scene.run()
        check('a callback that uses its scene', False)
    except RuntimeError:
        check('a callback that uses its scene', True)


def sweep(out, order):
    with sealbench.Scene(SCENES + 'thesis-cycle.scene') as own:
        for i in order:
            out[i] = own.evaluate(['cycle.force_breakaway_N'], {'gland.radial_space': 1.33e-3 + 5e-6 * i})


one: dict = {}
two: dict = {}
threads = [threading.Thread(target=sweep, args=(one, range(6))),
           threading.Thread(target=sweep, args=(two, reversed(range(6))))]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
check('two scenes in two threads', one == two and len(one) == 6, (one, two))

hints = [name for name in ('__init__', 'evaluate', 'frames', 'profile', 'callbacks', 'figure', 'run')
         if 'return' not in typing.get_type_hints(getattr(sealbench.Scene, name))]
check('typed and documented', not hints and all(
    getattr(sealbench.Scene, name).__doc__ for name in vars(sealbench.Scene)
    if callable(getattr(sealbench.Scene, name)) and not name.startswith('_') and name != 'text'), hints)
print(f'1..{len(results)}')
sys.exit(not all(results) or os.EX_OK)
