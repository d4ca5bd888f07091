# The installation folder of the Python package, below the prefix: where the Python it is built for
# looks for third-party packages. Debian's Python looks in dist-packages.
execute_process(
    COMMAND ${Python_EXECUTABLE} -c
"import sysconfig
scheme = 'posix_local' if 'posix_local' in sysconfig.get_scheme_names() else 'posix_prefix'
path = sysconfig.get_path('platlib', scheme, vars={'base': '', 'platbase': ''})
print(path.removeprefix('/local').lstrip('/'))"
    OUTPUT_VARIABLE packtrace_python_dir OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(PACKTRACE_PYTHON_DIR ${packtrace_python_dir} CACHE STRING
    "Where the Python package is installed, below the prefix")
