"""The command line as a module: ``python -m elbowroom``."""

from elbowroom_command import main

if __name__ == "__main__":
    main()
