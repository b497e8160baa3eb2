* Two products over 24 months, with stock, a store of 15 each, and overtime. Optimum 27092:
* the prices of the rows and the plan below satisfy complementary slackness, in whole numbers.
* Prices: DA01 40, DA02 42, DA03 44, DA04 46, DA05 46, DA06 44,
*         DA07 43, DA08 45, DA09 47, DA10 49, DA11 49, DA12 46,
*         DA13 44, DA14 46, DA15 48, DA16 50, DA17 47, DA18 43,
*         DA19 43, DA20 46, DA21 48, DA22 50, DA23 46, DA24 47,
*         DB01 55, DB02 57, DB03 59, DB04 61, DB05 58, DB06 56,
*         DB07 56, DB08 58, DB09 60, DB10 62, DB11 59, DB12 60,
*         DB13 60, DB14 62, DB15 64, DB16 66, DB17 62, DB18 61,
*         DB19 58, DB20 60, DB21 62, DB22 64, DB23 63, DB24 59,
*         CAP02 -1, CAP03 -6, CAP04 -4, CAP08 -2, CAP09 -6, CAP10 -1,
*         CAP14 -1, CAP15 -6, CAP16 -3, CAP20 -3, CAP21 -6, CAP22 -2.
* Plan: MAKEA01 15, MAKEA02 18, MAKEA03 24, MAKEA04 18, MAKEA05 16, MAKEA06 12,
*       MAKEA07 19, MAKEA08 18, MAKEA09 30, MAKEA10 24, MAKEA11 15, MAKEA12 6,
*       MAKEA13 14, MAKEA14 21, MAKEA15 24, MAKEA16 21, MAKEA17 12, MAKEA18 18,
*       MAKEA19 18, MAKEA20 18, MAKEA21 24, MAKEA22 18, MAKEA23 15, MAKEA24 13,
*       STOCKA01 9, STOCKA02 4, STOCKA03 7, STOCKA07 5, STOCKA08 8, STOCKA09 9,
*       STOCKA13 7, STOCKA14 4, STOCKA15 7, STOCKA19 15, STOCKA20 3, STOCKA21 3,
*       MAKEB01 5, MAKEB02 8, MAKEB03 8, MAKEB04 8, MAKEB05 5, MAKEB06 6,
*       MAKEB07 4, MAKEB08 8, MAKEB09 4, MAKEB10 4, MAKEB11 7, MAKEB12 8,
*       MAKEB13 7, MAKEB14 6, MAKEB15 8, MAKEB16 6, MAKEB17 6, MAKEB18 6,
*       MAKEB19 6, MAKEB20 8, MAKEB21 8, MAKEB22 8, MAKEB23 8, MAKEB24 5,
*       STOCKB01 5, STOCKB02 3, STOCKB03 7, STOCKB07 4, STOCKB08 7, STOCKB09 5,
*       STOCKB13 7, STOCKB14 7, STOCKB15 5, STOCKB19 3, STOCKB20 5, STOCKB21 5,
*       OVER03 12, OVER09 12, OVER15 12, OVER21 12.
NAME          PRODUCTION
ROWS
 N  COST
 E  DA01
 E  DA02
 E  DA03
 E  DA04
 E  DA05
 E  DA06
 E  DA07
 E  DA08
 E  DA09
 E  DA10
 E  DA11
 E  DA12
 E  DA13
 E  DA14
 E  DA15
 E  DA16
 E  DA17
 E  DA18
 E  DA19
 E  DA20
 E  DA21
 E  DA22
 E  DA23
 E  DA24
 E  DB01
 E  DB02
 E  DB03
 E  DB04
 E  DB05
 E  DB06
 E  DB07
 E  DB08
 E  DB09
 E  DB10
 E  DB11
 E  DB12
 E  DB13
 E  DB14
 E  DB15
 E  DB16
 E  DB17
 E  DB18
 E  DB19
 E  DB20
 E  DB21
 E  DB22
 E  DB23
 E  DB24
 L  CAP01
 L  CAP02
 L  CAP03
 L  CAP04
 L  CAP05
 L  CAP06
 L  CAP07
 L  CAP08
 L  CAP09
 L  CAP10
 L  CAP11
 L  CAP12
 L  CAP13
 L  CAP14
 L  CAP15
 L  CAP16
 L  CAP17
 L  CAP18
 L  CAP19
 L  CAP20
 L  CAP21
 L  CAP22
 L  CAP23
 L  CAP24
COLUMNS
    MAKEA01   COST                40   DA01                 1
    MAKEA01   CAP01                2
    MAKEA02   COST                40   DA02                 1
    MAKEA02   CAP02                2
    MAKEA03   COST                32   DA03                 1
    MAKEA03   CAP03                2
    MAKEA04   COST                38   DA04                 1
    MAKEA04   CAP04                2
    MAKEA05   COST                46   DA05                 1
    MAKEA05   CAP05                2
    MAKEA06   COST                44   DA06                 1
    MAKEA06   CAP06                2
    MAKEA07   COST                43   DA07                 1
    MAKEA07   CAP07                2
    MAKEA08   COST                41   DA08                 1
    MAKEA08   CAP08                2
    MAKEA09   COST                35   DA09                 1
    MAKEA09   CAP09                2
    MAKEA10   COST                47   DA10                 1
    MAKEA10   CAP10                2
    MAKEA11   COST                49   DA11                 1
    MAKEA11   CAP11                2
    MAKEA12   COST                46   DA12                 1
    MAKEA12   CAP12                2
    MAKEA13   COST                44   DA13                 1
    MAKEA13   CAP13                2
    MAKEA14   COST                44   DA14                 1
    MAKEA14   CAP14                2
    MAKEA15   COST                36   DA15                 1
    MAKEA15   CAP15                2
    MAKEA16   COST                44   DA16                 1
    MAKEA16   CAP16                2
    MAKEA17   COST                47   DA17                 1
    MAKEA17   CAP17                2
    MAKEA18   COST                43   DA18                 1
    MAKEA18   CAP18                2
    MAKEA19   COST                43   DA19                 1
    MAKEA19   CAP19                2
    MAKEA20   COST                40   DA20                 1
    MAKEA20   CAP20                2
    MAKEA21   COST                36   DA21                 1
    MAKEA21   CAP21                2
    MAKEA22   COST                46   DA22                 1
    MAKEA22   CAP22                2
    MAKEA23   COST                46   DA23                 1
    MAKEA23   CAP23                2
    MAKEA24   COST                47   DA24                 1
    MAKEA24   CAP24                2
    STOCKA01  COST                 2   DA01                -1
    STOCKA01  DA02                 1
    STOCKA02  COST                 2   DA02                -1
    STOCKA02  DA03                 1
    STOCKA03  COST                 2   DA03                -1
    STOCKA03  DA04                 1
    STOCKA04  COST                 2   DA04                -1
    STOCKA04  DA05                 1
    STOCKA05  COST                 2   DA05                -1
    STOCKA05  DA06                 1
    STOCKA06  COST                 2   DA06                -1
    STOCKA06  DA07                 1
    STOCKA07  COST                 2   DA07                -1
    STOCKA07  DA08                 1
    STOCKA08  COST                 2   DA08                -1
    STOCKA08  DA09                 1
    STOCKA09  COST                 2   DA09                -1
    STOCKA09  DA10                 1
    STOCKA10  COST                 2   DA10                -1
    STOCKA10  DA11                 1
    STOCKA11  COST                 2   DA11                -1
    STOCKA11  DA12                 1
    STOCKA12  COST                 2   DA12                -1
    STOCKA12  DA13                 1
    STOCKA13  COST                 2   DA13                -1
    STOCKA13  DA14                 1
    STOCKA14  COST                 2   DA14                -1
    STOCKA14  DA15                 1
    STOCKA15  COST                 2   DA15                -1
    STOCKA15  DA16                 1
    STOCKA16  COST                 2   DA16                -1
    STOCKA16  DA17                 1
    STOCKA17  COST                 2   DA17                -1
    STOCKA17  DA18                 1
    STOCKA18  COST                 2   DA18                -1
    STOCKA18  DA19                 1
    STOCKA19  COST                 2   DA19                -1
    STOCKA19  DA20                 1
    STOCKA20  COST                 2   DA20                -1
    STOCKA20  DA21                 1
    STOCKA21  COST                 2   DA21                -1
    STOCKA21  DA22                 1
    STOCKA22  COST                 2   DA22                -1
    STOCKA22  DA23                 1
    STOCKA23  COST                 2   DA23                -1
    STOCKA23  DA24                 1
    MAKEB01   COST                55   DB01                 1
    MAKEB01   CAP01                3
    MAKEB02   COST                54   DB02                 1
    MAKEB02   CAP02                3
    MAKEB03   COST                41   DB03                 1
    MAKEB03   CAP03                3
    MAKEB04   COST                49   DB04                 1
    MAKEB04   CAP04                3
    MAKEB05   COST                58   DB05                 1
    MAKEB05   CAP05                3
    MAKEB06   COST                56   DB06                 1
    MAKEB06   CAP06                3
    MAKEB07   COST                56   DB07                 1
    MAKEB07   CAP07                3
    MAKEB08   COST                52   DB08                 1
    MAKEB08   CAP08                3
    MAKEB09   COST                42   DB09                 1
    MAKEB09   CAP09                3
    MAKEB10   COST                59   DB10                 1
    MAKEB10   CAP10                3
    MAKEB11   COST                59   DB11                 1
    MAKEB11   CAP11                3
    MAKEB12   COST                60   DB12                 1
    MAKEB12   CAP12                3
    MAKEB13   COST                60   DB13                 1
    MAKEB13   CAP13                3
    MAKEB14   COST                59   DB14                 1
    MAKEB14   CAP14                3
    MAKEB15   COST                46   DB15                 1
    MAKEB15   CAP15                3
    MAKEB16   COST                57   DB16                 1
    MAKEB16   CAP16                3
    MAKEB17   COST                62   DB17                 1
    MAKEB17   CAP17                3
    MAKEB18   COST                61   DB18                 1
    MAKEB18   CAP18                3
    MAKEB19   COST                58   DB19                 1
    MAKEB19   CAP19                3
    MAKEB20   COST                51   DB20                 1
    MAKEB20   CAP20                3
    MAKEB21   COST                44   DB21                 1
    MAKEB21   CAP21                3
    MAKEB22   COST                58   DB22                 1
    MAKEB22   CAP22                3
    MAKEB23   COST                63   DB23                 1
    MAKEB23   CAP23                3
    MAKEB24   COST                59   DB24                 1
    MAKEB24   CAP24                3
    STOCKB01  COST                 2   DB01                -1
    STOCKB01  DB02                 1
    STOCKB02  COST                 2   DB02                -1
    STOCKB02  DB03                 1
    STOCKB03  COST                 2   DB03                -1
    STOCKB03  DB04                 1
    STOCKB04  COST                 2   DB04                -1
    STOCKB04  DB05                 1
    STOCKB05  COST                 2   DB05                -1
    STOCKB05  DB06                 1
    STOCKB06  COST                 2   DB06                -1
    STOCKB06  DB07                 1
    STOCKB07  COST                 2   DB07                -1
    STOCKB07  DB08                 1
    STOCKB08  COST                 2   DB08                -1
    STOCKB08  DB09                 1
    STOCKB09  COST                 2   DB09                -1
    STOCKB09  DB10                 1
    STOCKB10  COST                 2   DB10                -1
    STOCKB10  DB11                 1
    STOCKB11  COST                 2   DB11                -1
    STOCKB11  DB12                 1
    STOCKB12  COST                 2   DB12                -1
    STOCKB12  DB13                 1
    STOCKB13  COST                 2   DB13                -1
    STOCKB13  DB14                 1
    STOCKB14  COST                 2   DB14                -1
    STOCKB14  DB15                 1
    STOCKB15  COST                 2   DB15                -1
    STOCKB15  DB16                 1
    STOCKB16  COST                 2   DB16                -1
    STOCKB16  DB17                 1
    STOCKB17  COST                 2   DB17                -1
    STOCKB17  DB18                 1
    STOCKB18  COST                 2   DB18                -1
    STOCKB18  DB19                 1
    STOCKB19  COST                 2   DB19                -1
    STOCKB19  DB20                 1
    STOCKB20  COST                 2   DB20                -1
    STOCKB20  DB21                 1
    STOCKB21  COST                 2   DB21                -1
    STOCKB21  DB22                 1
    STOCKB22  COST                 2   DB22                -1
    STOCKB22  DB23                 1
    STOCKB23  COST                 2   DB23                -1
    STOCKB23  DB24                 1
    OVER01    COST                 6   CAP01               -1
    OVER02    COST                 6   CAP02               -1
    OVER03    COST                 6   CAP03               -1
    OVER04    COST                 6   CAP04               -1
    OVER05    COST                 6   CAP05               -1
    OVER06    COST                 6   CAP06               -1
    OVER07    COST                 6   CAP07               -1
    OVER08    COST                 6   CAP08               -1
    OVER09    COST                 6   CAP09               -1
    OVER10    COST                 6   CAP10               -1
    OVER11    COST                 6   CAP11               -1
    OVER12    COST                 6   CAP12               -1
    OVER13    COST                 6   CAP13               -1
    OVER14    COST                 6   CAP14               -1
    OVER15    COST                 6   CAP15               -1
    OVER16    COST                 6   CAP16               -1
    OVER17    COST                 6   CAP17               -1
    OVER18    COST                 6   CAP18               -1
    OVER19    COST                 6   CAP19               -1
    OVER20    COST                 6   CAP20               -1
    OVER21    COST                 6   CAP21               -1
    OVER22    COST                 6   CAP22               -1
    OVER23    COST                 6   CAP23               -1
    OVER24    COST                 6   CAP24               -1
RHS
    RHS       DA01                 6
    RHS       DA02                23
    RHS       DA03                21
    RHS       DA04                25
    RHS       DA05                16
    RHS       DA06                12
    RHS       DA07                14
    RHS       DA08                15
    RHS       DA09                29
    RHS       DA10                33
    RHS       DA11                15
    RHS       DA12                 6
    RHS       DA13                 7
    RHS       DA14                24
    RHS       DA15                21
    RHS       DA16                28
    RHS       DA17                12
    RHS       DA18                18
    RHS       DA19                 3
    RHS       DA20                30
    RHS       DA21                24
    RHS       DA22                21
    RHS       DA23                15
    RHS       DA24                13
    RHS       DB02                10
    RHS       DB03                 4
    RHS       DB04                15
    RHS       DB05                 5
    RHS       DB06                 6
    RHS       DB08                 5
    RHS       DB09                 6
    RHS       DB10                 9
    RHS       DB11                 7
    RHS       DB12                 8
    RHS       DB14                 6
    RHS       DB15                10
    RHS       DB16                11
    RHS       DB17                 6
    RHS       DB18                 6
    RHS       DB19                 3
    RHS       DB20                 6
    RHS       DB21                 8
    RHS       DB22                13
    RHS       DB23                 8
    RHS       DB24                 5
    RHS       CAP01               60
    RHS       CAP02               60
    RHS       CAP03               60
    RHS       CAP04               60
    RHS       CAP05               60
    RHS       CAP06               60
    RHS       CAP07               60
    RHS       CAP08               60
    RHS       CAP09               60
    RHS       CAP10               60
    RHS       CAP11               60
    RHS       CAP12               60
    RHS       CAP13               60
    RHS       CAP14               60
    RHS       CAP15               60
    RHS       CAP16               60
    RHS       CAP17               60
    RHS       CAP18               60
    RHS       CAP19               60
    RHS       CAP20               60
    RHS       CAP21               60
    RHS       CAP22               60
    RHS       CAP23               60
    RHS       CAP24               60
BOUNDS
 UP BND       STOCKA01            15
 UP BND       STOCKA02            15
 UP BND       STOCKA03            15
 UP BND       STOCKA04            15
 UP BND       STOCKA05            15
 UP BND       STOCKA06            15
 UP BND       STOCKA07            15
 UP BND       STOCKA08            15
 UP BND       STOCKA09            15
 UP BND       STOCKA10            15
 UP BND       STOCKA11            15
 UP BND       STOCKA12            15
 UP BND       STOCKA13            15
 UP BND       STOCKA14            15
 UP BND       STOCKA15            15
 UP BND       STOCKA16            15
 UP BND       STOCKA17            15
 UP BND       STOCKA18            15
 UP BND       STOCKA19            15
 UP BND       STOCKA20            15
 UP BND       STOCKA21            15
 UP BND       STOCKA22            15
 UP BND       STOCKA23            15
 UP BND       STOCKB01            15
 UP BND       STOCKB02            15
 UP BND       STOCKB03            15
 UP BND       STOCKB04            15
 UP BND       STOCKB05            15
 UP BND       STOCKB06            15
 UP BND       STOCKB07            15
 UP BND       STOCKB08            15
 UP BND       STOCKB09            15
 UP BND       STOCKB10            15
 UP BND       STOCKB11            15
 UP BND       STOCKB12            15
 UP BND       STOCKB13            15
 UP BND       STOCKB14            15
 UP BND       STOCKB15            15
 UP BND       STOCKB16            15
 UP BND       STOCKB17            15
 UP BND       STOCKB18            15
 UP BND       STOCKB19            15
 UP BND       STOCKB20            15
 UP BND       STOCKB21            15
 UP BND       STOCKB22            15
 UP BND       STOCKB23            15
 UP BND       OVER01              20
 UP BND       OVER02              20
 UP BND       OVER03              20
 UP BND       OVER04              20
 UP BND       OVER05              20
 UP BND       OVER06              20
 UP BND       OVER07              20
 UP BND       OVER08              20
 UP BND       OVER09              20
 UP BND       OVER10              20
 UP BND       OVER11              20
 UP BND       OVER12              20
 UP BND       OVER13              20
 UP BND       OVER14              20
 UP BND       OVER15              20
 UP BND       OVER16              20
 UP BND       OVER17              20
 UP BND       OVER18              20
 UP BND       OVER19              20
 UP BND       OVER20              20
 UP BND       OVER21              20
 UP BND       OVER22              20
 UP BND       OVER23              20
 UP BND       OVER24              20
ENDATA
