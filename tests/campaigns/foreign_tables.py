"""The tables' part of the campaign `foreign`: a loop with random noise as test machines export it, and a
random surface as instruments export it. The rms difference to the run and Sq must agree with those of the
plain file within 1e-4, or within the rounding of the format."""
import json
import os
import subprocess

import numpy

TOLERANCE = 1e-4
POUND, GRAM = 4.4482216152605, 9.80665e-3


def program(campaign, *arguments):
    result = subprocess.run([campaign.program, *arguments], capture_output=True, text=True, check=False)
    return (json.loads(result.stdout), '') if result.returncode == 0 else (None, result.stderr.strip())


def number(value, digits=5, mark='.', group=''):
    text = f'{value:,.{digits}f}' if group else f'{value:.{digits}f}'
    return text.replace(',', 'G').replace('.', mark).replace('G', group)


def rows(loop, cells, end='\n'):
    """Lines of cells, each a text with places t, x, f that are texts already."""
    return ''.join(cells(*row) + end for row in loop)


def machines(loop, draw):
    """Name, bytes and factor of the unit of force of every habit."""
    comma = lambda value, digits=5: number(value, digits, ',')
    q = lambda *cells: ','.join(f'"{cell}"' for cell in cells)
    late = draw.uniform(1, 30)
    yield 'plain brackets', 'Time [s],Extension [mm],Load [N]\n' + rows(
        loop, lambda t, x, f: f'{t:.5f},{x:.5f},{f:.5f}'), 1
    yield 'German, quoted commas, short row of units', 'Flaeche,"100,0",mm^2\n\nZeit,Weg,Kraft,Dehnung,Zyklus\n' \
        '(s),(mm),(N),(mm/mm)\n' + rows(loop, lambda t, x, f: q(comma(t), comma(x), comma(f), '0,1', '0,0')), 1
    yield 'grams and row of units', 'Force,Distance,Time\ng,mm,sec\n' + rows(
        loop, lambda t, x, f: f'{f / GRAM:.3f},{x:.5f},{t:.5f}'), 1
    yield 'underscores and a set', 'SetName,Cycle,Time_S,Size_mm,Displacement_mm,Force_N\n' + rows(
        loop, lambda t, x, f: f'press,1,{t:.5f},70.0,{x:.5f},{f:.5f}'), 1
    yield 'thousands in quotes', 'Time (s),Displacement (mm),Force (mN)\n' + rows(
        loop, lambda t, x, f: f'{t:.5f},{x:.5f},"{number(1e3 * f, 2, ".", ",")}"'), 1
    yield 'results before', 'Results Table 1\n,"Maximum Load","Extension at Maximum Load"\n,"(N)","(mm)"\n' \
        '1,"35.1","16.2"\n2,"35.3","16.1"\n\n"Raw Data"\n"Time","Extension","Load"\n"(s)","(mm)","(N)"\n' + rows(
            loop, lambda t, x, f: q(number(t), number(x + late), number(f))), 1
    yield 'results behind', 'Time,Extension,Load\n(s),(mm),(N)\n' + rows(
        loop, lambda t, x, f: f'{t:.5f},{x:.5f},{f:.5f}') + '\nResults\nNo,Peak,Mean\n1,900.0,1.0\n', 1
    yield 'French, tabs, Latin-1', ('Temps (s)\tÉcrasement (mm)\tEffort (N)\n' + rows(
        loop, lambda t, x, f: f'{comma(t)}\t{comma(x)}\t{comma(f)}')).encode('latin-1'), 1
    yield 'Italian, kp and mil', 'Tempo in s;Corsa in mil;Forza in kp\n' + rows(
        loop, lambda t, x, f: f'{comma(t)};{comma(x / 0.0254)};{comma(f / 9.80665, 6)}'), 1
    yield 'inches by a sign, pounds', 'Time (sec),Displacement ("),Force (lbf)\n' + rows(
        loop, lambda t, x, f: f'{t:.5f},{x / 25.4:.7f},{f / POUND:.6f}'), 1
    yield 'three ends of lines', 'Time (s),Disp (mm),Load (N)\r\r\n' + rows(
        loop, lambda t, x, f: f'{t:.5f},{x:.5f},{f:.5f}', '\r\r\n'), 1
    yield 'typographic minus', 'Time (s);Position (mm);Force (N)\n' + rows(
        loop, lambda t, x, f: f'{t:.5f};{x:.5f};{-f:.5f}'.replace('-', '−')), 1
    yield 'Shift-JIS', ('時間 (s),変位 (mm),荷重 (N)\n' + rows(
        loop, lambda t, x, f: f'{t:.5f},{x:.5f},{f:.5f}')).encode('shift-jis'), 1
    yield 'specimens side by side', 'Probe 1;;;Probe 2;;\nZeit;Weg;Kraft;Zeit;Weg;Kraft\ns;mm;N;s;mm;N\n' + rows(
        loop, lambda t, x, f: f'{comma(t)};{comma(x)};{comma(f)};{comma(t)};{comma(x / 2)};{comma(f / 3)}'), 1
    yield 'UTF-16 with units in words', ('Time Seconds\tTravel Millimeters\tForce Newtons\n' + rows(
        loop, lambda t, x, f: f'{t:.5f}\t{x:.5f}\t{f:.5f}')).encode('utf-16'), 1
    yield 'blank columns', '# bench\nTime (s)  Position (mm)  Force (kN)\n' + rows(
        loop, lambda t, x, f: f'  {t:9.5f}  {x:9.5f}  {f / 1e3:12.8f}'), 1
    yield 'names of a language that is not known', 'Tijd (s);Indrukking (mm);Kracht (N);Temp. (°C)\n' + rows(
        loop, lambda t, x, f: f'{comma(t)};{comma(x)};{comma(f)};23,5'), 1
    yield 'bars', '|Time|Travel|Force|\n|---|---|---|\n|(Sek.)|(in.)|(N)|\n' + rows(
        loop, lambda t, x, f: f'|{t:.5f}|{x / 25.4:.7f}|{f:.5f}|'), 1
    yield 'GBK', ('试验日期,2026年3月5日\n时间(秒),变形(毫米),负荷(牛)\n' + rows(
        loop, lambda t, x, f: f'{t:.5f},{x:.5f},{f:.5f}')).encode('gbk'), 1
    yield 'Cyrillic units', 'Время, с;Перемещение, мм;Нагрузка, кН\n' + rows(
        loop, lambda t, x, f: f'{comma(t)};{comma(x)};{comma(f / 1e3, 8)}'), 1
    yield 'specimens with letters', 'Weg_A [mm];Kraft_A [N];Weg_B [mm];Kraft_B [N]\n' + rows(
        loop, lambda t, x, f: f'{comma(x)};{comma(f)};{comma(x / 2)};{comma(f / 3)}'), 1
    yield 'no value in the first row', 'Time (s),Extension (mm),Load (N)\n0.0,0.0,NaN\n' + rows(
        loop, lambda t, x, f: f'{t:.5f},{x:.5f},{f:.5f}'), 1
    yield 'blanks and a row of units in brackets', 'Time Weg Kraft\n(s) (mm) (N)\n' + rows(
        loop, lambda t, x, f: f'{t:.5f} {x:.5f} {f:.5f}'), 1
    yield 'slashes and other units', 'Zeit / ms;Weg / µm;Kraft / cN\n' + rows(
        loop, lambda t, x, f: f'{comma(1e3 * t, 2)};{comma(1e3 * x, 2)};{comma(1e2 * f, 3)}'), 1


def surfaces(z, step, draw):
    """Name, bytes of every habit of a matrix [nm] with equal steps [m]."""
    height, width = z.shape
    sizes = width * step * 1e6, height * step * 1e6
    matrix = lambda mark='.', factor=1: '\n'.join('\t'.join(number(v / factor, 4, mark) for v in row) for row in z) + '\n'
    factor = draw.choice([0.25, 0.5, 2])
    yield 'English', f'# Channel: Height\n# Width: {sizes[0]} µm\n# Height: {sizes[1]} µm\n# Value units: nm\n' + matrix()
    yield 'German', f'# Kanal: Höhe\n# Breite: {sizes[0]} µm\n# Höhe: {sizes[1]} µm\n# Einheit der Werte: nm\n'.replace(
        '.', ',') + matrix(',')
    yield 'French', f'# Canal : Z\n# Largeur : {sizes[0]} µm\n# Hauteur : {sizes[1]} µm\n' \
        '# Unité des valeurs : nm\n' + matrix()
    yield 'Italian', f'# Canale: Z\n# Larghezza: {sizes[0]} µm\n# Altezza: {sizes[1]} µm\n' \
        '# Unità dei valori: nm\n' + matrix()
    yield 'Spanish', f'# Canal: Z\n# Anchura: {sizes[0]} µm\n# Altura: {sizes[1]} µm\n' \
        '# Unidades de los valores: nm\n' + matrix()
    yield 'multiplier', f'Width: {sizes[0]} um\nHeight: {sizes[1]} um\nZ unit: nm\nZ multiplier: {factor}\n' \
        + matrix('.', factor)
    yield 'factor', f'Width: {sizes[0]} um\nHeight: {sizes[1]} um\nZ unit: nm\nZ factor: {factor}\n' + matrix('.', factor)
    yield 'surface data file', f'aISO-1.0\nNumPoints = {width}\nNumProfiles = {height}\nXscale = {step!r}\nYscale = {step!r}\n' \
        'Zscale = 1e-9\nZresolution = -1\nCompression = 0\nDataType = 7\nCheckType = 0\n*\n' + matrix() + '*\n'


def write(campaign, content):
    path = os.path.join(campaign.folder, 'foreign.txt')
    with open(path, 'wb') as file:
        file.write(content if isinstance(content, bytes) else content.encode('utf-8'))
    return path


def check_all(campaign, kind, habits, figure):
    """Compares the figure of every habit with that of the first."""
    exact, worst, wrong, count = None, 0, 0, 0
    for name, content, *_ in habits:
        value, problem = figure(write(campaign, content))
        exact = value if exact is None else exact
        apart = abs(value / exact - 1) if value is not None and exact else 1
        worst, count = max(worst, apart), count + 1
        if apart > TOLERANCE:
            wrong += 1
            campaign.say(f'{kind}, {name}: {value} where {exact} is right; {problem}')
    campaign.ok(wrong == 0, f'{count} habits of {kind}, {wrong} wrong, at most {worst:.1e} apart')


def rms(campaign, path):
    root, problem = program(campaign, 'compare', 'thesis-cycle', '--measured', path, '--json', '-')
    return (root['measured']['rms_N'] if root else None), problem


def sq(campaign, path):
    root, problem = program(campaign, 'surface', path, '--json', '-')
    return (root['sq_m'] if root else None), problem


def run(campaign, until):
    draw, first = campaign.random, True
    folder = os.path.join(campaign.folder, 'exact')
    subprocess.run([campaign.program, 'run', 'thesis-cycle', '-o', folder, '--quiet'], check=True, capture_output=True)
    table = numpy.genfromtxt(os.path.join(folder, 'cycle.csv'), delimiter=',', skip_header=1)
    while first or campaign.left() > until:
        noise = numpy.random.default_rng(draw.randrange(2 ** 32))
        loop = [(row[0], 1e3 * row[1], row[3]) for row in table]
        loop = [(t, x, f + 0.2 * n) for (t, x, f), n in zip(loop, noise.standard_normal(len(loop)))]
        check_all(campaign, 'test machines', machines(loop, draw), lambda path: rms(campaign, path))
        z = noise.standard_normal((48, 64)).cumsum(axis=1) * 30
        check_all(campaign, 'scans', surfaces(z, 5e-7, draw), lambda path: sq(campaign, path))
        first = False
