"""Observed orders of convergence from results on refined meshes or steps."""

import math


def mesh_sizes(values):
    """Relative sizes h from the values of a refined entry, coarse to fine.

    Increasing values are numbers of cells (h = 1/value), decreasing ones are
    spacings or time steps (h = value). Units must be the same throughout.
    """
    numbers, units = [], set()
    for value in values:
        number, _, unit = value.strip().partition(" ")
        numbers.append(float(number))
        units.add(unit.strip())
    if len(units) > 1:
        raise ValueError(f"the values {', '.join(values)} have different units; "
                         "write all of them in one")
    steps = [b - a for a, b in zip(numbers, numbers[1:])]
    if min(numbers) > 0 and all(step > 0 for step in steps):
        return [1 / number for number in numbers]
    if min(numbers) > 0 and all(step < 0 for step in steps):
        return numbers
    raise ValueError(f"the values {', '.join(values)} must go from coarse to fine: "
                     "increasing numbers of cells, or decreasing steps")


def order_of_errors(h, errors):
    """Orders between successive meshes; None where an error is zero."""
    orders = []
    for k in range(len(h) - 1):
        a, b = abs(errors[k]), abs(errors[k + 1])
        orders.append(math.log(a / b) / math.log(h[k] / h[k + 1])
                      if a > 0 and b > 0 else None)
    return orders


def three_grid_order(h, x):
    """Order p and limit from three meshes, x = limit + c h^p.

    Solves (x1 - x2)/(x2 - x3) = (h1^p - h2^p)/(h2^p - h3^p). Returns
    (None, None) where the differences change sign or do not fall.
    """
    d12, d23 = x[0] - x[1], x[1] - x[2]
    if d23 == 0 or d12 / d23 <= 0:
        return None, None

    def mismatch(p):
        return (h[0]**p - h[1]**p) / (h[1]**p - h[2]**p) - d12 / d23

    low, high = 1e-3, 20.0
    if mismatch(low) * mismatch(high) > 0:
        return None, None
    for _ in range(100):
        middle = 0.5 * (low + high)
        if mismatch(low) * mismatch(middle) <= 0:
            high = middle
        else:
            low = middle
    p = 0.5 * (low + high)
    return p, x[2] - d23 * h[2]**p / (h[1]**p - h[2]**p)
