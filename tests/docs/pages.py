#!/usr/bin/python3
"""Runs the commands of one page of the documentation and compares their output with the page.

    pages.py [--rewrite] SOURCE BUILD PAGE      PAGE relative to SOURCE, e.g. docs/tutorial.md

Each page has a temporary folder with a copy of `assets`, links to `bindings` and `build`, and the built
programs on PATH. Blocks work in page order:

  sh       commands for a shell, each must succeed (exit code 0, or another one if the output that follows
           has an error line `sealbench: ...`). Variables and the current folder persist.
  text     directly below a sh, python or c block: the output, standard error included, of the block's last
           command. Lines must follow one another as in the output; a line `...` stands for any lines. The
           block need not begin or end where the output does. Figures are compared as text; MASKS in
           page.py lists what differs from run to run. A text block that follows no command is an error.
  python   a program for a fresh interpreter that finds the module.
  c        a program if it has main(): it is compiled, and run if a text block follows.
  plain    not checked (diagrams, equations).
  others   a file whose first line is a comment with its name alone (`# my.scene`). It is written, and
           `sealbench check` must find no problem in a valve, scene, study or rubber.

Figures that sentences and tables quote are held by a comment `<!-- sealbench ... prints 28.70 N; 0.30 N -->`:
each must be in the command's output and in the text of the page. The output of a command that the page has
already run is used again, by these comments and by `sealbench run` in a sentence.

A block without a language is an error, and so is one of another language without a name.

Code within a sentence that begins with `sealbench` is also run, after the block above it. If it has a word in
capitals or `...` in place of a value, only the command's name and its options are looked up, in
`COMMAND --help`; `sealbench thesis ITEM` is looked up in the list of items, since the campaign `thesis`
computes them. `meson test NAME` must name a test, "campaign `NAME`" a campaign, a source file
(`test_ring.c`, `params.def`) must exist, and so must the target of a link, heading included.

SKIPPED commands change the reader's system or need another machine. Commands that open the window or the
workbench of the terminal are started, on a display or terminal of their own, and ended. Commands that need
a feature which this build does not have are skipped.

--rewrite replaces the lines of text blocks by those of the output that differ from them in figures only,
and fills empty text blocks.
"""
import glob
import json
import os
import pty
import re
import resource
import select
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from page import PROGRAM, Page, difference, rewritten

DISPLAY = [os.path.join(os.path.dirname(os.path.abspath(__file__)), '../ui/display.sh'), '-screen 0 1400x1000x24']

SKIPPED = {'./run', './check', 'sudo', 'apt', 'apt-get', 'tools/setup', 'meson', 'ninja', 'git', 'cmake', 'pip',
           'mpirun', 'sbatch', 'man'}

# What a command needs that a build may not have, as `sealbench --version` names it.
FEATURES = [
    ('STEP', re.compile(r'\.step\b')),
    ('MP4', re.compile(r'\.(mp4|webp|apng|gif|mov)\b')),
    ('X3P', re.compile(r'\.x3p\b')),
    ('terminal', re.compile(r'^sealbench tui\b')),
    ('window', re.compile(r'^sealbench(-gtk| open)\b')),
]

PLACEHOLDER = re.compile(r'\b[A-Z]{2,}\b|…|\.\.\.|\[|\*|<')
TIMEOUT = 120


def split_commands(lines):
    """(offset, command) of a block: a command goes on while the shell finds it incomplete."""
    commands, begin, text = [], 0, ''
    for at, line in enumerate(lines):
        if text == '' and (line.strip() == '' or line.lstrip().startswith('#')):
            continue
        begin = begin if text else at
        text += line + '\n'
        parsed = subprocess.run(['bash', '-n', '-c', text], capture_output=True, text=True, check=False)
        if not line.endswith('\\') and parsed.returncode == 0 and parsed.stderr == '':
            commands.append((begin, text.rstrip('\n')))
            text = ''
    if text:
        commands.append((begin, text.rstrip('\n')))
    return commands


def processor_time():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Runner:
    def __init__(self, source, build, path, rewrite):
        self.source, self.build, self.path, self.rewrite = source, build, path, rewrite
        self.page = Page(os.path.join(source, path))
        self.count = self.failed = 0
        self.output, self.code, self.replaced, self.used, self.looked = None, 0, [], 0, 0
        self.outputs = {}

    def report(self, good, line, name, why=None, skip=None):
        self.count += 1
        self.failed += not good
        print('%sok %d - %s:%d %s%s' % ('' if good else 'not ', self.count, self.path, line,
                                        ' '.join(name.split()).replace('#', '')[:100],
                                        ' # SKIP ' + skip if skip else ''))
        for part in (why or '').split('\n') if not good else []:
            print('# ' + part)
        before, self.used = self.used, processor_time()
        if self.used - before > 1:
            print('# %.1f s of a processor' % (self.used - before))
        sys.stdout.flush()

    def set_up(self, folder):
        self.folder = os.path.join(folder, 'page')
        programs = os.path.join(folder, 'bin')
        home = os.path.join(folder, 'home')
        for each in (self.folder, programs, home):
            os.mkdir(each)
        shutil.copytree(os.path.join(self.source, 'assets'), os.path.join(self.folder, 'assets'))
        os.symlink(os.path.join(self.source, 'bindings'), os.path.join(self.folder, 'bindings'))
        os.symlink(self.build, os.path.join(self.folder, 'build'))
        for name in ('sealbench', 'ui/sealbench-gtk'):
            os.symlink(os.path.join(self.build, name), os.path.join(programs, os.path.basename(name)))
        self.state = os.path.join(folder, 'state')
        with open(self.state, 'w', encoding='utf-8') as file:
            file.write('cd %s\n' % shlex.quote(self.folder))
        library = os.path.join(self.build, 'app/library')
        self.env = {
            'PATH': programs + ':' + os.environ['PATH'], 'HOME': home, 'LC_ALL': 'C.UTF-8', 'TERM': 'dumb',
            'COLUMNS': '80', 'OPENBLAS_NUM_THREADS': '1', 'PYTHONDONTWRITEBYTECODE': '1',
            'PYTHONPATH': os.path.join(self.source, 'bindings/python'),
            'SEALBENCH_LIBRARY': os.path.join(library, 'libsealbench.so.0'),
            'FONTCONFIG_FILE': os.path.join(self.source, 'tests/app/fonts.conf'),
            # The library of the build, which pkg-config knows only where it will be installed.
            'CPATH': os.path.join(self.source, 'include'), 'LIBRARY_PATH': library,
            'LD_LIBRARY_PATH': library,
            'PKG_CONFIG_PATH': os.path.join(self.build, 'meson-uninstalled')}
        self.features = self.run(['sealbench', '--version'])[1]
        self.features = next((line for line in self.features if line.startswith('features ')), '')

    def run(self, command, folder=None):
        """Exit code and the lines of standard output and error."""
        with subprocess.Popen(command, cwd=folder or self.folder, env=self.env, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              encoding='utf-8', errors='replace', start_new_session=True) as process:
            try:
                text = process.communicate(timeout=TIMEOUT)[0]
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                return 124, ['took longer than %d s' % TIMEOUT]
        return process.returncode, text.rstrip('\n').split('\n')

    def run_shell(self, command):
        script = ('. %(state)s\n%(command)s\ncode=$?\n'
                  '{ export -p; printf "cd %%q\\n" "$PWD"; } > %(state)s\nexit $code\n')
        return self.run(['bash', '-c', script % {'state': shlex.quote(self.state), 'command': command}])

    def start_window(self, command):
        """Whether the window still runs a while after its start on a display of its own."""
        if shutil.which('Xvfb') is None or shutil.which('dbus-run-session') is None:
            return None
        with subprocess.Popen(['dbus-run-session', '--', *DISPLAY, 'bash', '-c', command],
                              cwd=self.folder, env=self.env, stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              start_new_session=True) as process:
            end = time.monotonic() + 2.5
            while process.poll() is None and time.monotonic() < end:
                time.sleep(0.1)
            runs = process.poll() is None
            if runs:
                os.killpg(process.pid, signal.SIGTERM)
        return runs

    def start_terminal(self, command):
        """Whether the workbench in a terminal draws its screen and ends by `q` with exit code 0."""
        pid, terminal = pty.fork()
        if pid == 0:
            os.chdir(self.folder)
            os.execvpe('bash', ['bash', '-c', 'stty rows 36 cols 120; ' + command],
                       {**self.env, 'TERM': 'xterm-256color'})
        drawn, end = 0, time.monotonic() + 60
        while time.monotonic() < end:
            # Silence after a screen of characters: it waits for a key.
            if select.select([terminal], [], [], 0.7)[0]:
                try:
                    drawn += len(os.read(terminal, 65536))
                except OSError:
                    break
            elif drawn > 1000:
                os.write(terminal, b'q')
        else:
            os.kill(pid, signal.SIGKILL)
        os.close(terminal)
        return os.waitpid(pid, 0)[1] == 0 and drawn > 1000

    def reason_to_skip(self, command):
        words = [word for word in command.split() if not re.match(r'\w+=', word)] or ['']
        if words[0] in SKIPPED:
            return 'not run here'
        plain = PROGRAM.sub(r'\1', command)
        for name, pattern in FEATURES:
            if pattern.search(plain) and not re.search(r'\b%s\b' % name, self.features):
                return 'a build without ' + name
        return None

    # ---- The kinds of blocks ----

    def finish(self, line, name, below):
        """Judges what ran: its exit code and the output below it, None without one."""
        kind, begin, text = below or ('', 0, [])
        why = None
        if (self.code != 0) != any(part.startswith('sealbench: ') and 'note: ' not in part for part in text):
            why = 'exit code %d\n%s' % (self.code, '\n'.join(self.output[-8:]))
        elif kind == 'text':
            if self.rewrite:
                new = rewritten(text, self.output)
                self.replaced.append((begin, len(text), new))
                text = new
            why = difference(text, self.output)
        if why is not None:
            why += '\noutput:\n' + '\n'.join(self.output[:20])
        self.report(why is None, line, name, why)

    def run_command(self, line, command, below=None):
        skip = self.reason_to_skip(command)
        plain = PROGRAM.sub(r'\1', command)
        if skip is not None:
            self.report(True, line, command, skip=skip)
        elif re.match(r'sealbench(-gtk| open)\b', plain) and '--' not in plain:
            files = [word for word in plain.split()[1:] if word != 'open']
            runs = self.start_window(command)
            # The window would stay open with a message where it cannot read its file.
            good = runs is not False and all(self.run(['sealbench', 'check', file])[0] == 0 for file in files)
            self.report(good, line, command, 'the window ended, or its file has a fault',
                        'without Xvfb' if runs is None else None)
        elif re.match(r'sealbench tui\b', plain) and '--help' not in plain:
            self.report(self.start_terminal(command), line, command, 'the workbench did not start or end')
        else:
            self.code, self.output = self.run_shell(command)
            self.outputs[command] = self.output
            self.finish(line, command, below)

    def hold_figures(self, line, command, figures):
        if command not in self.outputs:
            self.outputs[command] = self.run_shell(command)[1]
        output = ' '.join(' '.join(self.outputs[command]).split())
        missing = [each for each in figures if each not in output]
        unquoted = [each for each in figures if each not in self.page.text]
        self.report(not missing and not unquoted, line, command,
                    'not in the output: %s\nnot in the text of the page: %s' % (missing, unquoted))

    def run_sh(self, line, lines, below):
        commands = split_commands(lines)
        for at, command in commands[:-1]:
            self.run_command(line + at + 1, command)
        for at, command in commands[-1:]:
            self.run_command(line + at + 1, command, below)

    def run_python(self, line, lines, below):
        if not re.search(r'\bPython\b', self.features):
            self.report(True, line, 'python', skip='a build without Python')
            return
        self.code, self.output = self.run(['/usr/bin/python3', '-c', '\n'.join(lines)])
        self.finish(line, 'python', below)

    def run_c(self, line, lines, below):
        if 'main(' not in '\n'.join(lines):
            return
        with open(os.path.join(self.folder, 'page.c'), 'w', encoding='utf-8') as file:
            file.write('\n'.join(lines) + '\n')
        self.code, self.output = self.run_shell(
            'cc -std=c17 -Wall -Werror -o page page.c $(pkg-config --cflags --libs sealbench) -lm')
        if self.code == 0 and below is not None:
            self.code, self.output = self.run_shell('./page')
        self.finish(line, 'c', below)

    def write_file(self, kind, line, lines):
        name = re.match(r'#\s*([\w.-]+\.\w+)\s*$', lines[0]) if lines else None
        if name is None:
            self.report(False, line, kind, 'neither a language that is run nor a file with its name in the first line')
            return
        with open(os.path.join(self.folder, name.group(1)), 'w', encoding='utf-8') as file:
            file.write('\n'.join(lines) + '\n')
        self.outputs = {command: output for command, output in self.outputs.items() if name.group(1) not in command}
        if name.group(1).endswith(('.valve', '.scene', '.study', '.rubber')):
            self.code, self.output = self.run(['sealbench', 'check', name.group(1)])
            self.finish(line, name.group(1), None)

    def look_up(self, line, code):
        """A command without its values: its name and options, or the items of the thesis."""
        words = PROGRAM.sub('', code).split()
        if words[0].startswith('-') or 'COMMAND' in words[0]:
            self.report(True, line, code)
        elif words[0] == 'thesis' and len(words) > 1 and re.fullmatch(r'(table|figure)-[\d.]+', words[1]):
            known = any(words[1] in text.split() for text in self.run(['sealbench', 'thesis'])[1])
            self.report(known, line, code, 'no such item')
        else:
            status, text = self.run(['sealbench', words[0], '--help'])
            options = re.findall(r'--[a-z][\w-]*', ' '.join(words))
            missing = [each for each in options if each not in '\n'.join(text)]
            self.report(status == 0 and not missing, line, code,
                        'no such command' if status != 0 else 'no option ' + ', '.join(missing))

    def run_inline(self, line, code):
        words = PROGRAM.sub('', code).split()
        if not words:
            return
        named_only = (len(words) == 1 and not words[0].startswith('-')) or PLACEHOLDER.search(code)
        if PROGRAM.match(code).group(1) == 'sealbench' and (named_only or words[0] == 'thesis'):
            self.look_up(line, code)
        elif words[0] == 'run' and code in self.outputs:
            self.report(True, line, code)
        elif not PLACEHOLDER.search(code):
            self.run_command(line, code)

    def run_tests(self, line, code):
        with open(os.path.join(self.build, 'meson-info/intro-tests.json'), encoding='utf-8') as file:
            known = {test['name'] for test in json.load(file)}
        names = [word for word in code.split()[2:] if not word.startswith('-') and word[0].islower()]
        missing = [name for name in names if name not in known and not re.match(r'build\b', name)]
        self.report(not missing, line, code, 'no test ' + ', '.join(missing))

    def look_for_source(self, line, name):
        found = glob.glob('**/' + name, root_dir=self.source, recursive=True)
        self.look(line, name, any(not each.startswith('build') for each in found))

    def look_for_link(self, line, target):
        path, _, heading = target.partition('#')
        path = os.path.normpath(os.path.join(os.path.dirname(self.path), path)) if path else self.path
        good = os.path.exists(os.path.join(self.source, path))
        if good and heading:
            with open(os.path.join(self.source, path), encoding='utf-8') as file:
                titles = re.findall(r'^#+ +(.*?) *$', file.read(), re.MULTILINE)
            good = heading in [re.sub(r'[^\w -]', '', title.lower()).replace(' ', '-') for title in titles]
        self.look(line, target, good)

    def look(self, line, name, good):
        """Counts what is looked for; what is missing is a case of its own."""
        self.looked += 1
        if not good:
            self.report(False, line, name, 'does not exist')

    def run_items(self):
        for line, why in self.page.faults:
            self.report(False, line, 'block', why)
        items, runs = self.page.items, {'sh': self.run_sh, 'python': self.run_python, 'c': self.run_c}
        for at, (kind, line, lines) in enumerate(items):
            last, below = items[at - 1] if at > 0 else ('',), items[at + 1] if at + 1 < len(items) else ('',)
            if kind in runs:
                runs[kind](line, lines, below if below[0] == 'text' else None)
            elif kind == 'text' and last[0] not in runs:
                self.report(False, line, kind, 'follows no command (use `plain` for a diagram)')
            elif kind == 'inline':
                self.run_inline(line, lines)
            elif kind == 'tests':
                self.run_tests(line, lines)
            elif kind == 'source':
                self.look_for_source(line, lines)
            elif kind == 'campaign':
                self.look(line, lines, os.path.exists(os.path.join(self.source, 'tests/campaigns', lines)))
            elif kind == 'quoted':
                self.hold_figures(line, *lines)
            elif kind == 'link':
                self.look_for_link(line, lines)
            elif kind not in ('text', 'plain', 'prose', ''):
                self.write_file(kind, line, lines)

    def write_page(self):
        for begin, count, new in sorted(self.replaced, reverse=True):
            self.page.lines[begin:begin + count] = new
        with open(os.path.join(self.source, self.path), 'w', encoding='utf-8') as file:
            file.write('\n'.join(self.page.lines))


def pages(source):
    """The pages whose commands are run."""
    found = ['README.md'] + sorted(glob.glob('docs/**/*.md', root_dir=source, recursive=True))
    return [path for path in found if os.path.isfile(os.path.join(source, path))]


def main():
    arguments = [each for each in sys.argv[1:] if not each.startswith('--')]
    source, build, path = os.path.abspath(arguments[0]), os.path.abspath(arguments[1]), arguments[2]
    if not os.path.exists(os.path.join(source, path)):
        print('1..0 # SKIP the page was removed after the build was configured')
        return 0
    runner = Runner(source, build, path, '--rewrite' in sys.argv)
    with tempfile.TemporaryDirectory(prefix='sealbench-page-') as folder:
        runner.set_up(folder)
        runner.run_items()
    if runner.rewrite:
        runner.write_page()
    runner.report(True, 0, '%d links and names of sources' % runner.looked)
    print('# %.1f s of a processor in all' % processor_time())
    print('1..%d' % runner.count)
    return 1 if runner.failed else 0


if __name__ == '__main__':
    sys.exit(main())
