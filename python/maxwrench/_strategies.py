"""Measures and searches that users write."""

from . import _core
from ._arguments import shortened
from ._errors import bad_value


class Measure:
    """A measure of your own. Subclass it, and add an object by ``add_measure``.

    Attributes: ``name``, by which ``solve`` and ``evaluate`` find it; ``unit`` of its values, None
    for a wrench along c; ``supports_any``, whether ``wrench="any"`` has a meaning for it.

    A method ``derivatives(posture)`` may return the derivatives of the value by tau_d (n) and by
    J (6×n). Without it they are central differences of ``value``. Either way a value should depend
    on the posture by tau_d and J alone where searches use gradients.

    One object serves all threads; the interpreter runs one call at a time.

    >>> class Ease(maxwrench.Measure):
    ...     name, unit = "ease", "N^2 m^2"
    ...     def value(self, posture):
    ...         return -posture.tau_d @ posture.tau_d
    >>> maxwrench.add_measure(Ease())
    >>> answer = maxwrench.evaluate("fixed/push", [0.5], measure="ease")
    >>> answer.status, answer.unit
    ('optimal', 'N^2 m^2')
    """

    name = ""
    unit = None
    supports_any = False

    def value(self, posture):
        """Returns the value at a Posture; NaN where there is none."""
        raise NotImplementedError(f"{type(self).__name__}: got a Measure without a method value(posture)")


class Search:
    """A search of your own. Subclass it, and add an object by ``add_search``.

    Attributes: ``name``; ``local``, whether it finds no better maximum elsewhere;
    ``accepts_starts``, whether it continues from ``objective.starts`` and so can be a later stage.

    >>> class Sample(maxwrench.Search):
    ...     name = "my_sample"
    ...     def maximize(self, objective):
    ...         random = numpy.random.default_rng(objective.seed)
    ...         shape = objective.budget, objective.dimension
    ...         objective.values(random.uniform(objective.lower, objective.upper, shape))
    >>> maxwrench.add_search(Sample())
    >>> maxwrench.solve("planar/force", search="my_sample", budget=100).evaluations
    100
    """

    name = ""
    local = False
    accepts_starts = False

    def maximize(self, objective):
        """Evaluates an Objective as it likes; the best point counts. What it returns does not."""
        raise NotImplementedError(f"{type(self).__name__}: got a Search without a method maximize(objective)")


def _object(strategy, key, method):
    if isinstance(strategy, type):
        raise bad_value(key, f"the class {strategy.__name__}", f"an object: {strategy.__name__}()")
    if not callable(getattr(strategy, method, None)):
        raise bad_value(key, shortened(strategy), f"an object with {method}()")
    return strategy


def add_measure(measure):
    """Adds a Measure. A name that was added before is replaced.

    Raises:
        InputError: the name is empty, has other characters than letters, digits and "_", or is
            that of a built-in measure.

    >>> class Reserve(maxwrench.Measure):
    ...     name, unit = "reserve", "N"
    ...     def value(self, posture):
    ...         return numpy.min(posture.u_max - abs(numpy.linalg.lstsq(posture.B, posture.tau_d, rcond=None)[0]))
    >>> maxwrench.add_measure(Reserve())
    >>> maxwrench.evaluate("planar/force", [0, 0], measure="reserve").status
    'optimal'
    """
    _core._add_measure(_object(measure, "measure", "value"))


def add_search(search):
    """Adds a Search, which may also be a stage of others. A name that was added before is replaced.

    Raises:
        InputError: as ``add_measure``.

    >>> class Ends(maxwrench.Search):
    ...     name = "ends"
    ...     def maximize(self, objective):
    ...         objective.values([objective.lower, objective.upper])
    >>> maxwrench.add_search(Ends())
    >>> maxwrench.solve("planar/force", search="ends+lbfgs", budget=100).search
    'ends+lbfgs'
    """
    _core._add_search(_object(search, "search", "maximize"))
