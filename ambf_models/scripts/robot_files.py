"""A robot of the original is two files: NAME.yaml, on which gravity does not act, as in the original's, and
NAME_gravity.yaml, on which it does."""


def write(model, models, name, balance=None):
    """Writes both. `balance`: function that adds to the one with gravity what carries its links."""
    folder = models / "descriptions" / "multi-bodies" / "robots"
    model.write(folder / f"{name}.yaml")
    heavy = model.with_gravity()
    if balance:
        balance(heavy)
    heavy.write(folder / f"{name}_gravity.yaml")
