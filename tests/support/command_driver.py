"""The driver tests/driver/commands.cc: it starts once, and does what the program does with many command lines."""

import argparse
import os
import pathlib
import subprocess


def parser():
    """What the scripts that try many inputs take from the command line."""
    common = argparse.ArgumentParser()
    common.add_argument("supple")
    common.add_argument("--count", type=int, default=100)
    common.add_argument("--seed", type=int, default=1)
    common.add_argument("--only", type=int)
    common.add_argument("--driver")
    common.add_argument("--keep", type=pathlib.Path)
    common.add_argument("--messages", type=pathlib.Path, help="file for all messages, to be read")
    return common


class CommandDriver:
    """seconds: how long each command may compute; more: how long after that until it is killed."""

    def __init__(self, program, folder, environment, seconds, more=0, prepare=None):
        self.output, self.error = folder / "stdout", folder / "stderr"
        self.server = subprocess.Popen([program, str(int(seconds)), str(int(more))], env=environment,
                                       stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, preexec_fn=prepare)

    def run(self, folder, arguments):
        """Process id, exit status (or the negative signal), standard output and standard error, as bytes."""
        self.server.stdin.write("\x1f".join([str(folder), str(self.output), str(self.error), *arguments]) + "\n")
        self.server.stdin.flush()
        process, status = map(int, self.server.stdout.readline().split())
        return process, os.waitstatus_to_exitcode(status), self.output.read_bytes(), self.error.read_bytes()
