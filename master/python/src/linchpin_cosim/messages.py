"""Messages of the program."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

LEVELS = ("error", "warning")
BEHIND = ("help", "note")


@dataclass(frozen=True)
class Problem:
    """An error or a warning of the program."""

    level: str
    """`error` or `warning`."""
    message: str
    """Place, value, and what is allowed."""
    help: str = ""
    """What to do, if the program says so."""
    note: str = ""
    """What is left, if the program says so."""

    def __str__(self) -> str:
        """As the program tells it, without the level."""
        behind = ((name, getattr(self, name)) for name in BEHIND)
        return "\n".join([self.message, *(f"  {name}: {text}" for name, text in behind if text)])


def read_messages(text: str) -> tuple[list[Problem], list[str]]:
    """The problems that the error output of the program tells, and its other lines."""
    blocks: list[tuple[str, dict[str, str]]] = []
    part, others = "", []
    for line in text.splitlines():
        name, is_named, told = line.strip().partition(": ")
        is_start = bool(is_named) and name in LEVELS and not line.startswith(" ")
        if is_start:
            part = "message"
            blocks.append((name, {part: told}))
        elif blocks and line.startswith("  "):
            texts = blocks[-1][1]
            if is_named and name in BEHIND:
                part = name
                texts[part] = told
            else:
                texts[part] += f" {line.strip()}"
        elif line.strip():
            others.append(line)
    return [Problem(level, **texts) for level, texts in blocks], others


def told(problems: Sequence[Problem], others: Sequence[str]) -> str:
    """The errors among the problems in one text; if there are none, the other lines."""
    errors = [str(problem) for problem in problems if problem.level == "error"]
    return "\n".join(errors or others) or "the program told no reason"
