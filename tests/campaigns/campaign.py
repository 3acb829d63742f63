"""What the campaigns share. A campaign is an executable file in this folder:

    NAME BUILD --slice SECONDS --seed N    a part of it, random by the seed, that ends in that time
    NAME BUILD --full [--seed N]           all of it

BUILD is a build folder of Meson's. A campaign prints TAP: a line for each thing that it promises,
with what is needed to repeat a failure (the seed, the parameters, the command). `./check` runs the
slices that meson.build registers, `./check --campaigns` runs every campaign in full: about 20 minutes
of two cores for fuzz, 10 of one for rings, 10 for analysis, 1 for mechanism and steady.
"""
import argparse
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

# Small matrices many times: threads of the library would wait for each other.
os.environ['OPENBLAS_NUM_THREADS'] = '1'
SOURCE = os.path.abspath(os.path.join(os.path.dirname(__file__), '..', '..'))


class Campaign:
    """Arguments, time and TAP output of one campaign. Used as a context: prints the plan last, and
    removes `folder`, a place for files, unless something failed."""

    def __init__(self, text, add_options=None):
        """`add_options` receives the parser: options of the campaign itself, kept in `options`."""
        parser = argparse.ArgumentParser(description=text)
        parser.add_argument('build')
        parser.add_argument('--slice', type=float, metavar='SECONDS')
        parser.add_argument('--full', action='store_true')
        parser.add_argument('--seed', type=int, default=1)
        if add_options:
            add_options(parser)
        options = self.options = parser.parse_args()
        if options.full == (options.slice is not None):
            parser.error('give either --slice SECONDS or --full')
        self.build = os.path.abspath(options.build)
        self.program = os.path.join(self.build, 'sealbench')
        os.environ['SEALBENCH_PROGRAM'] = self.program
        os.environ['SEALBENCH_ASSETS'] = os.path.join(SOURCE, 'assets')
        self.full = options.full
        self.seed = options.seed
        self.random = random.Random(options.seed)
        self.start = time.monotonic()
        self.seconds = options.slice
        self.count = self.failed = 0
        self.keep = False  # whether the folder stays

    def __enter__(self):
        name = os.path.splitext(os.path.basename(sys.argv[0]))[0]
        self.folder = tempfile.mkdtemp(prefix=f'sealbench-{name}-')
        self.say(f'seed {self.seed}')
        return self

    def __exit__(self, kind, value, trace):
        if kind is not None:
            self.ok(False, f'the campaign ended by {kind.__name__}: {value}')
        print(f'1..{self.count}', flush=True)
        if self.failed or self.keep:
            self.say(f'files are left in {self.folder}')
        else:
            subprocess.run(['rm', '-rf', self.folder], check=False)
        if kind is None:
            sys.exit(self.failed > 0)

    def left(self):
        """Seconds of the slice that are left; infinite in a full run."""
        if self.full:
            return float('inf')
        return self.seconds - (time.monotonic() - self.start)

    def ok(self, good, text):
        """A line of the result; returns whether it is good."""
        self.count += 1
        self.failed += not good
        print('ok' if good else 'not ok', self.count, '-', ' '.join(str(text).split()), flush=True)
        return good

    def skip(self, text, reason):
        self.count += 1
        print('ok', self.count, '-', text, '# SKIP', reason, flush=True)

    def run(self, command, text, **options):
        """One result for a command that must succeed; its output if it does not."""
        result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                errors='replace', check=False, **options)
        if not self.ok(result.returncode == 0, text):
            self.say(f'{command} ended by {result.returncode}')
            self.say(result.stdout[-8000:])
        return result.returncode == 0

    def configure(self, build, *options, **environment):
        """Sets up a build folder of the campaign's own, unless it is there."""
        name = os.path.basename(build)
        if 'CC' in environment and shutil.which('ccache'):
            # Meson takes it by itself only where CC is not set.
            environment['CC'] = 'ccache ' + environment['CC']
        return os.path.exists(build + '/build.ninja') or self.run(
            ['meson', 'setup', build, SOURCE, *options], f'{name}: set up with {" ".join(options)}',
            env={**os.environ, **environment})

    def ninja(self, build, *targets):
        return self.run(['ninja', '-C', build, *targets], f'{os.path.basename(build)}: built')

    @staticmethod
    def say(text):
        """Notes: what was tried, what a failure printed."""
        for line in str(text).splitlines():
            print('#', line, flush=True)
