"""Contradictions inside one JSON document of `sealbench run`: a null without a reason, a fraction
outside 0 to 1, a stage's force above the peak, a verdict against its figure, an open balance of
energies, a large estimate without a warning, a state of the solver that the exit code denies."""
import math

STAGES = 'ABCDEF'


def values(node, path=''):
    """Pairs of path and value of everything that is no object and no array."""
    if isinstance(node, dict):
        for key, value in node.items():
            yield from values(value, f'{path}.{key}' if path else key)
    elif isinstance(node, list):
        for index, value in enumerate(node):
            yield from values(value, f'{path}[{index}]')
    else:
        yield path, node


def missing(results):
    reasons = results['reasons']
    for path, value in values({k: v for k, v in results.items() if k not in ('reasons', 'warnings')}):
        explained = any(path == key or path.startswith((key + '.', key + '[')) for key in reasons)
        if value is None and 'verdict' not in path and not explained:
            yield f'null without a reason: {path}'
        if isinstance(value, float) and not math.isfinite(value):
            yield f'not finite: {path}'


def energies(cycle):
    energy = cycle.get('energy', {})
    closure = cycle.get('energy_closure')
    if closure is not None and abs(closure) > 1e-3:
        yield f'energy_closure {closure}'
    external = energy.get('external_J')
    if external is not None:
        terms = ('friction_J', 'stored_J', 'seal_J', 'kinetic_J', 'stop_J')
        total = sum(energy.get(term) or 0 for term in terms)
        if abs(external - total) > 1e-3 * max(abs(energy.get('external_max_J') or 0), 1e-30):
            yield f'external work {external}, sum of the others {total}'


def stages(cycle):
    marks = [cycle['stages'][name] for name in STAGES]
    times = [mark['time_s'] for mark in marks if mark['time_s'] is not None]
    if any(later < sooner - 1e-12 for sooner, later in zip(times, times[1:])):
        yield f'stages out of order: {times}'
    peak = cycle['force_peak_N']
    for name, mark in zip(STAGES, marks):
        force = mark['force_N']
        if peak is not None and force is not None and force > peak * (1 + 1e-6) + 1e-9:
            yield f'force {force} at stage {name} above the peak {peak}'


def differ(a, b):
    return (a is None) != (b is None) or a is not None and abs(a - b) > 1e-6 * max(abs(a), abs(b))


def forces(results):
    """Break-away, press force and peak; figures that the JSON states twice."""
    cycle = results['cycle']
    names = ('force_breakaway_N', 'force_press_N', 'force_peak_N')
    known = [(name, cycle[name]) for name in names if cycle[name] is not None]
    for (name, force), (bound, above) in zip(known, known[1:]):
        if force > above * (1 + 1e-6) + 1e-9:
            yield f'{name} {force} above {bound} {above}'
    slip = cycle['stages']['B']['force_N']
    if results['solver']['converged'] and slip is not None and differ(slip, cycle['force_breakaway_N']):
        yield f'force at stage B {slip}, break-away {cycle["force_breakaway_N"]}'
    for name, seal in results.get('seals', {}).items():
        state = seal['contact']['in_stroke']
        for key in ('load_N', 'contact_width_m', 'pressure_peak_Pa', 'film_min_m', 'film_central_m',
                    'real_area_share'):
            if state['state'] is not None and differ(seal[key], state[key]):
                yield f'{name}: {key} {seal[key]}, in the stroke {state[key]}'


def outcome(cycle):
    """The outcome against the figures that follow from it."""
    kind = cycle.get('outcome')
    if kind is None:
        return
    null = set()
    if kind == 'never-moved':
        null = {'force_return_min_N', 'force_return_margin_N', 'leakage_per_cycle_m3'}
        if cycle['dose_mass_kg']:
            yield f'never moved, dose {cycle["dose_mass_kg"]}'
    if kind in ('never-moved', 'stuck'):
        null.add('leakage_carried_all_actuations_m3')
    if (cycle['stuck_at_m'] is not None) != (kind == 'stuck'):
        yield f'outcome {kind}, stuck at {cycle["stuck_at_m"]}'
    if kind == 'stuck' and (cycle['force_return_margin_N'] or 0) > 0:
        yield f'stuck with a margin of {cycle["force_return_margin_N"]}'
    for key in null:
        if cycle[key] is not None:
            yield f'outcome {kind}, {key} {cycle[key]}'


def verdict(cycle):
    returns = cycle['verdict']['returns']
    if returns['ok'] and returns.get('value') is not None and returns['value'] < 0:
        yield f'"returns: yes" decided by {returns["value"]}'
    outcome = cycle.get('outcome')
    if outcome is not None and bool(cycle['returns']) != (outcome == 'returned'):
        yield f'returns {cycle["returns"]}, outcome {outcome}'
    if cycle['returns'] and cycle.get('dose_mass_kg') and cycle['stages']['C']['time_s'] is None:
        yield 'a dose without stage C'
    for name, judged in cycle['verdict'].items():
        if judged['ok'] is None and not judged['reason']:
            yield f'verdict {name} is null without a reason'


def seals(results):
    shares = ('real_area_share', 'asperity_load_share', 'leakage_static_real_area_share',
              'friction_static_real_area_share')
    for name, seal in results.get('seals', {}).items():
        least, central = seal.get('film_min_m'), seal.get('film_central_m')
        if least is not None and central is not None and least > central * 1.001:
            yield f'{name}: least film above the central one'
        for share in shares:
            if seal.get(share) is not None and not -1e-9 <= seal[share] <= 1 + 1e-7:
                yield f'{name}: {share} {seal[share]}'
        peak, width, load = (seal.get(key) for key in
                             ('pressure_peak_Pa', 'contact_width_m', 'load_N_per_m'))
        if peak and width and load and peak * width < 0.99 * load:
            yield f'{name}: load above peak times width'


def solver(results, code):
    state = results['solver']
    if state['converged'] != (code == 0):
        yield f'converged {state["converged"]}, exit code {code}'
    warned = any('estimate' in warning['code'] or 'error' in warning['code']
                 for warning in results['warnings'])
    large = {f'solver.{k}': v for k, v in state['error_estimate'].items()}
    large |= {k: v for k, v in results.get('error_estimates', {}).items()}
    large = {name: estimate for name, estimate in large.items() if (estimate or 0) > 0.3}
    if large and not warned:
        yield f'estimates without a warning: {large}'
    if max(large.values(), default=0) > 1 and state['converged']:
        yield f'converged with estimates above 1: {large}'


def contradictions(results, code):
    """All of them, one text each; `code` is the exit code, 0 or 2."""
    if results['models']['motion'] == 'rig':
        return [*missing(results), *solver(results, code)]
    return [*missing(results), *energies(results['cycle']), *stages(results['cycle']),
            *verdict(results['cycle']), *outcome(results['cycle']), *forces(results), *seals(results),
            *solver(results, code)]
