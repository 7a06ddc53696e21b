"""The driver tests/driver/commands.cc: it starts once, and does what the program does with many command lines."""

import os
import subprocess

import runner


class CommandDriver:
    """seconds: how long each command may compute; more: how long after that until it is killed."""

    def __init__(self, program, folder, seconds, more=0, environment=(), prepare=None):
        self.output, self.error = folder / "stdout", folder / "stderr"
        self.server = subprocess.Popen([program, str(int(seconds)), str(int(more))], env=dict(runner.ENVIRONMENT, **dict(environment)),
                                       stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, preexec_fn=prepare)

    def run(self, folder, arguments):
        """Process id, exit status (or the negative signal), standard output and standard error, as bytes."""
        self.server.stdin.write("\x1f".join([str(folder), str(self.output), str(self.error), *arguments]) + "\n")
        self.server.stdin.flush()
        process, status = map(int, self.server.stdout.readline().split())
        return process, os.waitstatus_to_exitcode(status), self.output.read_bytes(), self.error.read_bytes()
