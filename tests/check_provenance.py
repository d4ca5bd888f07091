"""check_provenance.py CMAKE ROOT: builds and scripts of results name a clean commit by its hash, and
another state with "-dirty". Scripts refuse to measure a dirty state unless told to. Builds also have a
digest of their sources. The test uses a repository of its own."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

CMAKE, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])
IDENTITY = ["-c", "user.name=test", "-c", "user.email=test@localhost"]


def stamped(repository):
    """The commit in the stamp of a build of the repository."""
    stamp = repository.parent / "stamp.cpp"
    subprocess.run([CMAKE, f"-DSOURCE={repository}", f"-DOUTPUT={stamp}", "-DFLAGS=-O3", "-P",
                    ROOT / "cmake/write_build_stamp.cmake"], check=True)
    return re.search('built_commit = "(.*)"', stamp.read_text())[1]


def sources_digest(repository):
    """The digest of the sources in the stamp of a build of the repository."""
    stamped(repository)
    return re.search('built_sources = "(.*)"', (repository.parent / "stamp.cpp").read_text())[1]


def measuring(repository, allow=""):
    """The exit code of the check that scripts make before they measure."""
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
        head = subprocess.run([*git, "rev-parse", "--short", "HEAD"], check=True,
                              capture_output=True, text=True).stdout.strip()

        expect("a clean commit", (stamped(repository), measuring(repository)), (head, 0))
        (repository / "results/some.json").write_text('{"a": 1}\n')
        expect("a new result", (stamped(repository), measuring(repository)), (head, 0))
        (repository / "source.cpp").write_text("int b;\n")
        expect("a changed source", (stamped(repository), measuring(repository)), (head + "-dirty", 1))
        expect("a changed source that is allowed", measuring(repository, "1"), 0)
        clean = sources_digest(repository)
        (repository / "src/kernels").mkdir(parents=True)
        (repository / "src/kernels/kernel.hpp").write_text("int k;\n")
        expect("a kernel's source", sources_digest(repository) == clean, True)
        (repository / "src/reference.hpp").write_text("int a;\n")
        one = sources_digest(repository)
        (repository / "src/reference.hpp").write_text("int b;\n")
        other = sources_digest(repository)
        expect("three states of the sources", len({clean, one, other}), 3)
        shutil.rmtree(repository / ".git")
        expect("no repository", stamped(repository), "unknown")


main()
