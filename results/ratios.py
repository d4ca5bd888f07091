"""How runs compare that were measured by turns."""
import statistics


def share(of, over):
    """Median and range of the ratios of runs that stood next to each other."""
    ratios = [a / b for a, b in zip(of, over)]
    return {"median": statistics.median(ratios), "lowest": min(ratios), "highest": max(ratios)}
