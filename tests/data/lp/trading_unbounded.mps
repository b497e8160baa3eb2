* Six currencies over five days; every trade loses but one circle on day 3: 2 -> 4 -> 5 -> 2 at 1, 1
* and 1.25. Unbounded: X24T3 = X45T3 = X52T3 = 1 leaves 0.25 of currency 2, kept until END2.
NAME          TRADING_UNBOUNDED
ROWS
 N  COST
 E  N1T1
 E  N2T1
 E  N3T1
 E  N4T1
 E  N5T1
 E  N6T1
 E  N1T2
 E  N2T2
 E  N3T2
 E  N4T2
 E  N5T2
 E  N6T2
 E  N1T3
 E  N2T3
 E  N3T3
 E  N4T3
 E  N5T3
 E  N6T3
 E  N1T4
 E  N2T4
 E  N3T4
 E  N4T4
 E  N5T4
 E  N6T4
 E  N1T5
 E  N2T5
 E  N3T5
 E  N4T5
 E  N5T5
 E  N6T5
COLUMNS
    X12T1     N1T1                 1   N2T1             -0.93
    X13T1     N1T1                 1   N3T1             -0.93
    X14T1     N1T1                 1   N4T1             -0.95
    X15T1     N1T1                 1   N5T1             -0.97
    X16T1     N1T1                 1   N6T1             -0.91
    KEEP1T1   N1T1                 1   N1T2                -1
    X21T1     N2T1                 1   N1T1             -0.91
    X23T1     N2T1                 1   N3T1             -0.97
    X24T1     N2T1                 1   N4T1             -0.95
    X25T1     N2T1                 1   N5T1             -0.93
    X26T1     N2T1                 1   N6T1             -0.93
    KEEP2T1   N2T1                 1   N2T2                -1
    X31T1     N3T1                 1   N1T1             -0.97
    X32T1     N3T1                 1   N2T1             -0.97
    X34T1     N3T1                 1   N4T1             -0.97
    X35T1     N3T1                 1   N5T1             -0.93
    X36T1     N3T1                 1   N6T1             -0.93
    KEEP3T1   N3T1                 1   N3T2                -1
    X41T1     N4T1                 1   N1T1             -0.93
    X42T1     N4T1                 1   N2T1             -0.97
    X43T1     N4T1                 1   N3T1             -0.91
    X45T1     N4T1                 1   N5T1             -0.91
    X46T1     N4T1                 1   N6T1             -0.93
    KEEP4T1   N4T1                 1   N4T2                -1
    X51T1     N5T1                 1   N1T1             -0.91
    X52T1     N5T1                 1   N2T1             -0.95
    X53T1     N5T1                 1   N3T1             -0.91
    X54T1     N5T1                 1   N4T1             -0.95
    X56T1     N5T1                 1   N6T1             -0.97
    KEEP5T1   N5T1                 1   N5T2                -1
    X61T1     N6T1                 1   N1T1             -0.97
    X62T1     N6T1                 1   N2T1             -0.97
    X63T1     N6T1                 1   N3T1             -0.97
    X64T1     N6T1                 1   N4T1             -0.97
    X65T1     N6T1                 1   N5T1             -0.93
    KEEP6T1   N6T1                 1   N6T2                -1
    X12T2     N1T2                 1   N2T2             -0.95
    X13T2     N1T2                 1   N3T2             -0.91
    X14T2     N1T2                 1   N4T2             -0.91
    X15T2     N1T2                 1   N5T2             -0.93
    X16T2     N1T2                 1   N6T2             -0.97
    KEEP1T2   N1T2                 1   N1T3                -1
    X21T2     N2T2                 1   N1T2             -0.93
    X23T2     N2T2                 1   N3T2             -0.95
    X24T2     N2T2                 1   N4T2             -0.97
    X25T2     N2T2                 1   N5T2             -0.95
    X26T2     N2T2                 1   N6T2             -0.97
    KEEP2T2   N2T2                 1   N2T3                -1
    X31T2     N3T2                 1   N1T2             -0.97
    X32T2     N3T2                 1   N2T2             -0.95
    X34T2     N3T2                 1   N4T2             -0.97
    X35T2     N3T2                 1   N5T2             -0.93
    X36T2     N3T2                 1   N6T2             -0.95
    KEEP3T2   N3T2                 1   N3T3                -1
    X41T2     N4T2                 1   N1T2             -0.91
    X42T2     N4T2                 1   N2T2             -0.95
    X43T2     N4T2                 1   N3T2             -0.93
    X45T2     N4T2                 1   N5T2             -0.95
    X46T2     N4T2                 1   N6T2             -0.91
    KEEP4T2   N4T2                 1   N4T3                -1
    X51T2     N5T2                 1   N1T2             -0.93
    X52T2     N5T2                 1   N2T2             -0.95
    X53T2     N5T2                 1   N3T2             -0.95
    X54T2     N5T2                 1   N4T2             -0.91
    X56T2     N5T2                 1   N6T2             -0.91
    KEEP5T2   N5T2                 1   N5T3                -1
    X61T2     N6T2                 1   N1T2             -0.97
    X62T2     N6T2                 1   N2T2             -0.97
    X63T2     N6T2                 1   N3T2             -0.91
    X64T2     N6T2                 1   N4T2             -0.95
    X65T2     N6T2                 1   N5T2             -0.91
    KEEP6T2   N6T2                 1   N6T3                -1
    X12T3     N1T3                 1   N2T3             -0.97
    X13T3     N1T3                 1   N3T3             -0.93
    X14T3     N1T3                 1   N4T3             -0.91
    X15T3     N1T3                 1   N5T3             -0.95
    X16T3     N1T3                 1   N6T3             -0.97
    KEEP1T3   N1T3                 1   N1T4                -1
    X21T3     N2T3                 1   N1T3             -0.97
    X23T3     N2T3                 1   N3T3             -0.91
    X24T3     N2T3                 1   N4T3                -1
    X25T3     N2T3                 1   N5T3             -0.91
    X26T3     N2T3                 1   N6T3             -0.97
    KEEP2T3   N2T3                 1   N2T4                -1
    X31T3     N3T3                 1   N1T3             -0.95
    X32T3     N3T3                 1   N2T3             -0.95
    X34T3     N3T3                 1   N4T3             -0.93
    X35T3     N3T3                 1   N5T3             -0.91
    X36T3     N3T3                 1   N6T3             -0.95
    KEEP3T3   N3T3                 1   N3T4                -1
    X41T3     N4T3                 1   N1T3             -0.91
    X42T3     N4T3                 1   N2T3             -0.91
    X43T3     N4T3                 1   N3T3             -0.91
    X45T3     N4T3                 1   N5T3                -1
    X46T3     N4T3                 1   N6T3             -0.93
    KEEP4T3   N4T3                 1   N4T4                -1
    X51T3     N5T3                 1   N1T3             -0.97
    X52T3     N5T3                 1   N2T3             -1.25
    X53T3     N5T3                 1   N3T3             -0.95
    X54T3     N5T3                 1   N4T3             -0.93
    X56T3     N5T3                 1   N6T3             -0.91
    KEEP5T3   N5T3                 1   N5T4                -1
    X61T3     N6T3                 1   N1T3             -0.95
    X62T3     N6T3                 1   N2T3             -0.95
    X63T3     N6T3                 1   N3T3             -0.95
    X64T3     N6T3                 1   N4T3             -0.93
    X65T3     N6T3                 1   N5T3             -0.97
    KEEP6T3   N6T3                 1   N6T4                -1
    X12T4     N1T4                 1   N2T4             -0.97
    X13T4     N1T4                 1   N3T4             -0.97
    X14T4     N1T4                 1   N4T4             -0.97
    X15T4     N1T4                 1   N5T4             -0.91
    X16T4     N1T4                 1   N6T4             -0.95
    KEEP1T4   N1T4                 1   N1T5                -1
    X21T4     N2T4                 1   N1T4             -0.97
    X23T4     N2T4                 1   N3T4             -0.93
    X24T4     N2T4                 1   N4T4             -0.95
    X25T4     N2T4                 1   N5T4             -0.97
    X26T4     N2T4                 1   N6T4             -0.95
    KEEP2T4   N2T4                 1   N2T5                -1
    X31T4     N3T4                 1   N1T4             -0.95
    X32T4     N3T4                 1   N2T4             -0.95
    X34T4     N3T4                 1   N4T4             -0.91
    X35T4     N3T4                 1   N5T4             -0.97
    X36T4     N3T4                 1   N6T4             -0.95
    KEEP3T4   N3T4                 1   N3T5                -1
    X41T4     N4T4                 1   N1T4             -0.91
    X42T4     N4T4                 1   N2T4             -0.97
    X43T4     N4T4                 1   N3T4             -0.93
    X45T4     N4T4                 1   N5T4             -0.91
    X46T4     N4T4                 1   N6T4             -0.95
    KEEP4T4   N4T4                 1   N4T5                -1
    X51T4     N5T4                 1   N1T4             -0.97
    X52T4     N5T4                 1   N2T4             -0.95
    X53T4     N5T4                 1   N3T4             -0.95
    X54T4     N5T4                 1   N4T4             -0.95
    X56T4     N5T4                 1   N6T4             -0.97
    KEEP5T4   N5T4                 1   N5T5                -1
    X61T4     N6T4                 1   N1T4             -0.91
    X62T4     N6T4                 1   N2T4             -0.91
    X63T4     N6T4                 1   N3T4             -0.91
    X64T4     N6T4                 1   N4T4             -0.95
    X65T4     N6T4                 1   N5T4             -0.95
    KEEP6T4   N6T4                 1   N6T5                -1
    X12T5     N1T5                 1   N2T5             -0.97
    X13T5     N1T5                 1   N3T5             -0.95
    X14T5     N1T5                 1   N4T5             -0.95
    X15T5     N1T5                 1   N5T5             -0.93
    X16T5     N1T5                 1   N6T5             -0.95
    END1      N1T5                 1
    X21T5     N2T5                 1   N1T5             -0.93
    X23T5     N2T5                 1   N3T5             -0.95
    X24T5     N2T5                 1   N4T5             -0.95
    X25T5     N2T5                 1   N5T5             -0.95
    X26T5     N2T5                 1   N6T5             -0.95
    END2      COST                -1   N2T5                 1
    X31T5     N3T5                 1   N1T5             -0.97
    X32T5     N3T5                 1   N2T5             -0.91
    X34T5     N3T5                 1   N4T5             -0.91
    X35T5     N3T5                 1   N5T5             -0.93
    X36T5     N3T5                 1   N6T5             -0.95
    END3      N3T5                 1
    X41T5     N4T5                 1   N1T5             -0.93
    X42T5     N4T5                 1   N2T5             -0.95
    X43T5     N4T5                 1   N3T5             -0.93
    X45T5     N4T5                 1   N5T5             -0.95
    X46T5     N4T5                 1   N6T5             -0.93
    END4      N4T5                 1
    X51T5     N5T5                 1   N1T5             -0.97
    X52T5     N5T5                 1   N2T5             -0.91
    X53T5     N5T5                 1   N3T5             -0.91
    X54T5     N5T5                 1   N4T5             -0.95
    X56T5     N5T5                 1   N6T5             -0.95
    END5      N5T5                 1
    X61T5     N6T5                 1   N1T5             -0.93
    X62T5     N6T5                 1   N2T5             -0.97
    X63T5     N6T5                 1   N3T5             -0.93
    X64T5     N6T5                 1   N4T5             -0.91
    X65T5     N6T5                 1   N5T5             -0.95
    END6      N6T5                 1
RHS
    RHS       N1T1               100
ENDATA
