"""The program ``elbowroom`` from its first moment on: Ctrl-C while it is still being read is no fault."""

import sys


def main() -> None:
    """Run the program."""
    try:
        from elbowroom._cli import main as run

        run()
    except KeyboardInterrupt:
        print("error: interrupted", file=sys.stderr)
        sys.exit(130)
