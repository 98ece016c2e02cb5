"""Looks into a message as the rows that people read."""


def value(rows, *names):
    """The value of a field, by the names on its way."""
    row = next(each for each in rows if each[0] == names[0])
    return row[1] if len(names) == 1 else value(row[2], *names[1:])
