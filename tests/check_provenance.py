"""check_provenance.py ROOT: scripts that measure refuse to while sources differ from the commit, unless
told. Tried in a repository of its own."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1])
IDENTITY = ["-c", "user.name=test", "-c", "user.email=test@localhost"]


def measuring(repository, allow=""):
    """The exit code of what scripts ask before they measure."""
    done = subprocess.run([sys.executable, "-B", repository / "results/provenance.py"],
                          env={**os.environ, "PACKTRACE_ALLOW_DIRTY": allow}, capture_output=True)
    return done.returncode


def expect(what, value, wanted):
    if value != wanted:
        sys.exit(f"{what}: {value} instead of {wanted}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        repository = pathlib.Path(folder) / "repository"
        git = ["git", "-C", repository, *IDENTITY]
        (repository / "results").mkdir(parents=True)
        shutil.copy(ROOT / "results/provenance.py", repository / "results")
        (repository / "source.cpp").write_text("int a;\n")
        (repository / "results/some.json").write_text("{}\n")
        subprocess.run(["git", "init", "-q", repository], check=True)
        subprocess.run([*git, "add", "-A"], check=True)
        subprocess.run([*git, "commit", "-qm", "First"], check=True)

        expect("a clean commit", measuring(repository), 0)
        (repository / "results/some.json").write_text('{"a": 1}\n')
        expect("a new result", measuring(repository), 0)
        (repository / "source.cpp").write_text("int b;\n")
        expect("a changed source", measuring(repository), 1)
        expect("a changed source that is allowed", measuring(repository, "1"), 0)


main()
