#!/usr/bin/python3
"""The example files are what tools/examples writes, and they are small.

    test_examples.py SOURCE                     SEALBENCH_PROGRAM is the program that computes the loop

The STEP file is left out: its text depends on the version of OpenCASCADE.
"""
import os
import subprocess
import sys
import tempfile

NAMES = ['bore-scan.txt', 'valve.dxf', 'valve-stem.stl', 'bench-loop.csv', 'titles.ini']
BYTES_MAX = 300000


def contents(folder, name):
    with open(os.path.join(folder, name), 'rb') as file:
        return file.read()


def main():
    source = os.path.abspath(sys.argv[1])
    shipped = os.path.join(source, 'assets/examples')
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([os.path.join(source, 'tools/examples'), folder, *NAMES], check=True)
        for count, name in enumerate(NAMES, 1):
            same = contents(folder, name) == contents(shipped, name)
            print('%sok %d - %s is what tools/examples writes' % ('' if same else 'not ', count, name))
    size = sum(len(contents(shipped, name)) for name in os.listdir(shipped))
    print('%sok %d - %d bytes of examples' % ('' if size < BYTES_MAX else 'not ', len(NAMES) + 1, size))
    print('1..%d' % (len(NAMES) + 1))


main()
