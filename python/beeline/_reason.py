"""The class of reasons."""

from __future__ import annotations

from typing import Union

FieldValue = Union[bool, int, float, str, "list[float]"]


class Reason(str):
    """Why there is no answer, or not the best: one sentence, empty without a reason, with its data.

    A program asks for `code` and `fields`: numbers of moves, segments and samples count from 1;
    metres, radians, seconds. `details` are other reasons that it rests on. Two reasons are equal if
    the sentence and all data are; a reason equals a str that is its sentence."""

    code: str
    fields: dict[str, FieldValue]
    details: list[Reason]

    def __new__(
        cls,
        sentence: str = "",
        code: str = "none",
        fields: dict[str, FieldValue] | None = None,
        details: list[Reason] | None = None,
    ) -> Reason:
        reason = super().__new__(cls, sentence)
        reason.code = code
        reason.fields = fields or {}
        reason.details = details or []
        return reason

    def __eq__(self, other: object) -> bool:
        if not str.__eq__(self, other):
            return False
        if not isinstance(other, Reason):
            return True
        return (self.code, self.fields, self.details) == (other.code, other.fields, other.details)

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        """The hash of the sentence, as of an equal str."""
        return str.__hash__(self)

    def __reduce__(self) -> tuple[type, tuple[str, str, dict[str, FieldValue], list[Reason]]]:
        return Reason, (str(self), self.code, self.fields, self.details)
