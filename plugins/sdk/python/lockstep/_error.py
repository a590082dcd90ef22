"What the package raises."


class Error(Exception):
    """What lockstep reports when a tree is wrong (`code` 3), a plugin is refused (4) or a leaf has a fault (5):
    the exit codes of the program. A closed tree, and one that is in use, have code 2.

    Of trees in this process, `diagnostics` has what is wrong with a tree, and `node` is the path of the leaf
    that has a fault. `__cause__` is the exception of the leaf."""

    def __init__(self, code, text, diagnostics=(), node=None):
        super().__init__(text.strip() or f"exit code {code}")
        self.code, self.diagnostics, self.node = code, list(diagnostics), node
